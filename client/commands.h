// The commands of `antipode`. Each takes the arguments after its name and throws Error.
#pragma once

#include <string>
#include <vector>

namespace antipode {

void renderCommand(const std::vector<std::string>& arguments);
void explainCommand(const std::vector<std::string>& arguments);
void devicesCommand(const std::vector<std::string>& arguments);
void compareCommand(const std::vector<std::string>& arguments);
void studyCommand(const std::vector<std::string>& arguments);
void tonemapCommand(const std::vector<std::string>& arguments);

}  // namespace antipode
