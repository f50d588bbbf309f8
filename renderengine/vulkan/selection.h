// Which of the listed devices a user means, and which is best; works on the list alone.
#pragma once

#include "renderengine/devices.h"

namespace antipode {

/// Best first: usable before unusable, discrete > integrated > virtual > CPU, then the larger memory, then the index.
void sortByRank(std::vector<DeviceInfo>& devices);

/// What `selectDevice` returns when `devices`, sorted by rank, are all there are. A selector of fewer than four decimal
/// digits is an index, one with a colon a PCI id, anything else the UUID or its beginning (case and dashes are
/// ignored). Throws Error(Usage) where nothing or more than one matches, Error(Device) where what matches is not
/// usable.
DeviceInfo chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& selector);

}  // namespace antipode
