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

namespace {

// A path below a folder as it is spelled there, where that differs in the case of letters at most: files come from
// systems that do not tell. Empty where there is none.
fs::path inOtherCase(const fs::path& folder, const fs::path& name) {
    constexpr int kMostEntries = 10'000;
    fs::path at = folder;
    for (const fs::path& part : name) {
        std::error_code failed;
        if (part == "." || part == ".." || fs::exists(at / part, failed)) {
            at /= part;
            continue;
        }
        fs::path found;
        int entries = 0;
        for (fs::directory_iterator entry(at, failed), end; !failed && entry != end; entry.increment(failed)) {
            if (++entries > kMostEntries) break;
            if (!sameButCase(entry->path().filename().string(), part.string())) continue;
            // The order of a folder's entries is chance.
            if (found.empty() || entry->path() < found) found = entry->path();
        }
        if (found.empty()) return {};
        at = found;
    }
    return at;
}

}  // namespace

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
        file = inOtherCase(folder_, name);
        if (!file.empty() && !admits(file)) return {Place::outside, {}};
    }
    if (!fs::is_regular_file(file, failed)) return {};
    return {Place::inside, file};
}

}  // namespace lutka::animation::rig_import
