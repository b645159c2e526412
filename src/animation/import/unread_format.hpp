#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/result.hpp"

namespace lutka::animation::rig_import {

/// The refusal of a file in a format that is known but not read (Urho3D's and MikuMikuDance's old models, scenes of
/// modelling programs, USD, assets of engines), with the program that can export it again; nothing for any other file.
/// `start` holds the file's first bytes, some hundred of them.
[[nodiscard]] std::optional<Error> unreadFormat(const std::filesystem::path& file, std::string_view start);

}  // namespace lutka::animation::rig_import
