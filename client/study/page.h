// The study as one page that needs no network.
#pragma once

#include <string>

namespace antipode::study {

/// `json`: studyJson() with pictures. Holds the plotting library (Chart.js) and its licence.
std::string studyPage(const std::string& json);

}  // namespace antipode::study
