#include "animation/import/model_folder.hpp"

#include <algorithm>
#include <system_error>

namespace lutka::animation::rig_import {

namespace fs = std::filesystem;

ModelFolder::ModelFolder(const fs::path& model, bool allowOutside)
    : folder_(model.has_parent_path() ? model.parent_path() : fs::path(".")), allowOutside_(allowOutside) {
    std::error_code failed;
    resolved_ = fs::canonical(folder_, failed);
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
    const fs::path file = folder_ / name;  // an absolute name takes the folder's place
    if (!admits(file)) return {Place::outside, {}};
    std::error_code failed;
    if (!fs::is_regular_file(file, failed)) return {};
    return {Place::inside, file};
}

}  // namespace lutka::animation::rig_import
