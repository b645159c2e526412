#include "editor/files/file_list.hpp"

#include <algorithm>
#include <cstdlib>

#include "animation/import/model_ending.hpp"
#include "core/letter_case.hpp"

namespace lutka::editor {
namespace {

constexpr std::string_view kRecordingEnd = ".recording";

// A profile or a scene; other JSON is none of ours.
bool isOurs(const std::filesystem::path& file) {
    const std::string name = lowerCased(file.filename().string());
    return name.ends_with(".ragdoll.json") || name.ends_with(".scene.json");
}

}  // namespace

const char* filterName(FileFilter filter) {
    switch (filter) {
        case FileFilter::models:
            return "Models, profiles, scenes";
        case FileFilter::profiles:
            return "Profiles (*.json)";
        case FileFilter::baked:
            return "Baked models (*.glb)";
        case FileFilter::skies:
            return "Panoramas (*.hdr)";
        case FileFilter::recordings:
            return "Recordings (*.recording)";
        case FileFilter::all:
            break;
    }
    return "All files";
}

bool isModel(const std::filesystem::path& file) {
    return animation::hasModelEnding(file);
}

bool passes(FileFilter filter, const std::filesystem::path& file) {
    const std::string end = lowerCased(file.extension().string());
    switch (filter) {
        case FileFilter::models:
            return isOurs(file) || isModel(file);
        case FileFilter::profiles:
            return end == ".json";
        case FileFilter::baked:
            return end == ".glb";
        case FileFilter::skies:
            return end == ".hdr";
        case FileFilter::recordings:
            return end == kRecordingEnd;
        case FileFilter::all:
            break;
    }
    return true;
}

std::vector<FileEntry> listFolder(const std::filesystem::path& folder, FileFilter filter) {
    std::vector<FileEntry> entries;
    std::error_code failed;
    std::filesystem::directory_iterator at(folder.empty() ? "." : folder,
                                           std::filesystem::directory_options::skip_permission_denied, failed);
    for (; !failed && at != std::filesystem::directory_iterator(); at.increment(failed)) {
        const std::string name = at->path().filename().string();
        std::error_code ignored;
        const bool isFolder = at->is_directory(ignored);
        if (name.front() == '.' || (!isFolder && !passes(filter, at->path()))) continue;
        if (entries.size() == kMaxFileEntries) break;
        entries.push_back({name, isFolder});
    }
    std::sort(entries.begin(), entries.end(), [](const FileEntry& a, const FileEntry& b) {
        if (a.folder != b.folder) return a.folder;
        return std::pair(lowerCased(a.name), a.name) < std::pair(lowerCased(b.name), b.name);
    });
    return entries;
}

std::string readablePath(const std::filesystem::path& path) {
    std::string text = path.lexically_normal().string();
    const char* home = std::getenv("HOME");
    const std::string_view prefix = home != nullptr ? home : "";
    const bool below =
        !prefix.empty() && text.starts_with(prefix) && (text.size() == prefix.size() || text[prefix.size()] == '/');
    return below ? "~" + text.substr(prefix.size()) : text;
}

std::string nameAmong(std::span<const std::filesystem::path> files, const std::filesystem::path& file) {
    const auto isCalledSo = [&](const std::filesystem::path& other) {
        return other != file && other.filename() == file.filename();
    };
    const bool alone = std::none_of(files.begin(), files.end(), isCalledSo);
    return alone ? file.filename().string() : (file.parent_path().filename() / file.filename()).string();
}

}  // namespace lutka::editor
