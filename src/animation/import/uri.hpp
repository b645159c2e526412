#pragma once

#include <string>

namespace lutka::animation::rig_import {

/// "%20" and the like as the bytes they stand for; what is no such escape stays.
[[nodiscard]] std::string decodePercents(const std::string& uri);

}  // namespace lutka::animation::rig_import
