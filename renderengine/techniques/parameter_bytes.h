// The parameters of a job and of a dispatch as the kernels of a precision read them.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/shared/layout.h"
#include "renderengine/settings.h"

namespace antipode {

std::vector<std::byte> parameterBytes(const shared::JobParameters<double>& parameters, Precision precision);
std::vector<std::byte> parameterBytes(const shared::Real4<double>& parameters, Precision precision);
std::vector<std::byte> parameterBytes(const shared::DispatchParameters<double>& parameters, Precision precision);

}  // namespace antipode
