#pragma once

#include <map>
#include <string>

#include "options.hpp"

namespace lutka::cli {

/// What of the options says how a run begins and goes on (the scene, its start, clip and muscles), for a file of
/// inputs: the words of the command line by the options' names, without those that were not given.
[[nodiscard]] std::map<std::string, std::string> inputSettings(const SimulateOptions& options);

/// Takes them over; leaves with ErrorCode::input on what is no such setting. `file` names their file.
void takeSettings(const std::map<std::string, std::string>& settings, const std::filesystem::path& file,
                  SimulateOptions& options);

}  // namespace lutka::cli
