#pragma once

#include <string_view>

namespace lutka {

/// The version of the headers at hand, as MAJOR.MINOR.PATCH (semver.org). Below 1.0.0 a new minor version may change
/// any interface.
inline constexpr int kVersionMajor = 0;
inline constexpr int kVersionMinor = 2;
inline constexpr int kVersionPatch = 0;
inline constexpr std::string_view kVersion = "0.2.0";

}  // namespace lutka
