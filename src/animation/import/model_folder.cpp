#include "animation/import/model_folder.hpp"

#include <algorithm>
#include <system_error>

#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {

namespace fs = std::filesystem;

ModelFolder::ModelFolder(const fs::path& model, bool allowOutside)
    : folder_(model.has_parent_path() ? model.parent_path() : fs::path(".")), allowOutside_(allowOutside) {
    std::error_code failed;
    resolved_ = fs::canonical(folder_, failed);
}

fs::path ModelFolder::spelledOtherwise(const fs::path& folder, const std::string& name) const {
    constexpr std::size_t kMostEntries = 10'000;
    std::error_code failed;
    const auto [listed, isNew] = listed_.try_emplace(fs::canonical(folder, failed));
    std::map<std::string, std::string>& entries = listed->second;
    std::size_t count = 0;
    if (isNew) {
        for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
            if (++count > kMostEntries) break;
            const std::string found = at->path().filename().string();
            std::string& known = entries[lowerCased(found)];
            // The order of a folder's entries is chance.
            if (known.empty() || found < known) known = found;
        }
    }
    if (count > kMostEntries) entries.clear();  // which of them came first is chance, too
    const auto entry = entries.find(lowerCased(name));
    return entry == entries.end() ? fs::path() : folder / entry->second;
}

// A path below the folder as it is spelled there, where that differs in the case of letters at most: files come from
// systems that do not tell. Empty where there is none, and only its start where that is not admitted.
fs::path ModelFolder::inOtherCase(const fs::path& name) const {
    fs::path at = folder_;
    for (const fs::path& part : name) {
        std::error_code failed;
        if (part == "." || part == ".." || fs::exists(at / part, failed)) {
            at /= part;
            continue;
        }
        if (!admits(at)) return at;  // a link that leads away is not looked into
        at = spelledOtherwise(at, part.string());
        if (at.empty()) return {};
    }
    return at;
}

bool ModelFolder::admits(const fs::path& place) const {
    if (allowOutside_) return true;
    std::error_code failed;
    const fs::path resolved = fs::weakly_canonical(place, failed);
    if (failed || resolved_.empty()) return false;
    // Relative paths of a place above begin with "..", that of the folder itself is ".".
    const fs::path inside = resolved.lexically_relative(resolved_);
    return !inside.empty() && *inside.begin() != "..";
}

ModelFolder::Named ModelFolder::find(const std::string& written) const {
    std::string name = written;
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.empty() || name.find('\0') != std::string::npos) return {};
    if (name.size() > 1 && name[1] == ':') return {};
    fs::path file = folder_ / name;  // an absolute name takes the folder's place
    if (!admits(file)) return {Place::outside, {}};
    std::error_code failed;
    if (!fs::exists(file, failed) && !fs::path(name).is_absolute()) {
        file = inOtherCase(name);
        if (!file.empty() && !admits(file)) return {Place::outside, {}};
    }
    if (!fs::is_regular_file(file, failed)) return {};
    return {Place::inside, file};
}

fs::path ModelFolder::fileIn(const fs::path& folder, const std::string& name) const {
    if (!admits(folder)) return {};  // a link that leads away
    std::error_code failed;
    for (const fs::path& file : {folder / name, spelledOtherwise(folder, name)}) {
        if (!file.empty() && fs::is_regular_file(file, failed) && admits(file)) return file;
    }
    return {};
}

}  // namespace lutka::animation::rig_import
