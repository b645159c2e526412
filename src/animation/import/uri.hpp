#pragma once

#include <string>

namespace lutka::animation::rig_import {

/// "%20" and the like as the bytes they stand for; what is no such escape stays.
[[nodiscard]] std::string decodePercents(const std::string& uri);

/// ASCII letters made small, for names and endings that are compared whatever their case.
[[nodiscard]] std::string lowerCased(std::string text);

}  // namespace lutka::animation::rig_import
