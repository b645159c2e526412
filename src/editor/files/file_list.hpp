#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lutka::editor {

/// What a file dialog shows.
enum class FileFilter {
    models,    ///< Rigged characters, profiles and scenes.
    profiles,  ///< *.json
    baked,     ///< *.glb
    skies,     ///< *.hdr
    recordings,
    all,
};
[[nodiscard]] const char* filterName(FileFilter filter);
/// By the end of the name, whatever its case. Folders always pass.
[[nodiscard]] bool passes(FileFilter filter, const std::filesystem::path& file);

/// Whether its name is that of a rigged character.
[[nodiscard]] bool isModel(const std::filesystem::path& file);

struct FileEntry {
    std::string name;
    bool folder = false;
};
/// What is in a folder, without hidden files: folders first, each by name without regard to case; at most
/// `kMaxFileEntries`. Empty when it can't be read.
inline constexpr std::size_t kMaxFileEntries = 2000;
[[nodiscard]] std::vector<FileEntry> listFolder(const std::filesystem::path& folder, FileFilter filter);

/// A path as people read it: the home folder as "~".
[[nodiscard]] std::string readablePath(const std::filesystem::path& path);

/// The file's name, with its folder's before it where others of the files are called the same: "knight/model.fbx".
[[nodiscard]] std::string nameAmong(std::span<const std::filesystem::path> files, const std::filesystem::path& file);

}  // namespace lutka::editor
