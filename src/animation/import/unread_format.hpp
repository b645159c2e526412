#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// The refusal of a file in a format that is known but not read, with the program that can export it again; nothing for
/// any other file. Known are Urho3D's and MikuMikuDance's old models, scenes of modelling programs, USD and assets of
/// engines.
/// `start` holds the file's first bytes, some hundred of them.
[[nodiscard]] std::optional<Error> unreadFormat(const std::filesystem::path& file, std::string_view start);

}  // namespace lutka::animation::rig_import
