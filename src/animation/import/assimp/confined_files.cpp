#include "animation/import/assimp/confined_files.hpp"

#include <string_view>
#include <system_error>
#include <utility>

#include "animation/import/source_limits.hpp"

namespace lutka::animation::rig_import {

namespace fs = std::filesystem;

ConfinedFiles::ConfinedFiles(fs::path model, ModelFolder folder, std::shared_ptr<std::set<std::string>> refused)
    : model_(std::move(model)), folder_(std::move(folder)), refused_(std::move(refused)) {}

bool ConfinedFiles::mayOpen(const std::string& file) const {
    if (model_ == file) return true;
    if (!folder_.admits(file)) {
        refused_->insert(file);
        return false;
    }
    std::error_code failed;
    return fs::is_regular_file(file, failed) && fs::file_size(file, failed) <= kMaxFileBytes && !failed;
}

bool ConfinedFiles::Exists(const char* file) const {
    return mayOpen(file) && DefaultIOSystem::Exists(file);
}

Assimp::IOStream* ConfinedFiles::Open(const char* file, const char* mode) {
    const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    return reads && mayOpen(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
}

bool ConfinedFiles::CreateDirectory(const std::string& /*path*/) {
    return false;
}

bool ConfinedFiles::DeleteFile(const std::string& /*file*/) {
    return false;
}

}  // namespace lutka::animation::rig_import
