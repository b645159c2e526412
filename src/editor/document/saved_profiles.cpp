#include "editor/document/saved_profiles.hpp"

#include <algorithm>
#include <utility>

namespace lutka::editor {

void SavedProfiles::remember(const std::filesystem::path& base, const std::filesystem::path& file, std::string json) {
    saved_[base] = {file, std::move(json)};
    own_.push_back(file);
}

std::optional<std::filesystem::path> SavedProfiles::fileOf(const std::filesystem::path& base) const {
    const auto saved = saved_.find(base);
    if (saved == saved_.end() || saved->second.file.empty()) return std::nullopt;
    return saved->second.file;
}

bool SavedProfiles::differs(const std::filesystem::path& base, const std::string& json) const {
    const auto saved = saved_.find(base);
    return saved == saved_.end() || saved->second.json != json;
}

bool SavedProfiles::wouldReplace(const std::filesystem::path& file) const {
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return false;
    return std::none_of(own_.begin(), own_.end(), [&](const std::filesystem::path& own) {
        return std::filesystem::equivalent(own, file, failed);
    });
}

}  // namespace lutka::editor
