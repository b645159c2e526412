#include "animation/import/assimp/confined_files.hpp"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "animation/import/assimp/b3d_bytes.hpp"
#include "animation/import/assimp/collada_clips.hpp"
#include "animation/import/assimp/collada_curves.hpp"
#include "animation/import/assimp/collada_ids.hpp"
#include "animation/import/assimp/collada_links.hpp"
#include "animation/import/assimp/collada_matrices.hpp"
#include "animation/import/assimp/collada_nodes.hpp"
#include "animation/import/assimp/collada_sources.hpp"
#include "animation/import/assimp/collada_text.hpp"
#include "animation/import/assimp/ogre_material.hpp"
#include "animation/import/source_limits.hpp"
#include "core/files.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {

namespace fs = std::filesystem;

namespace {

// A Collada document as Assimp reads it rightly; each step takes the text that the one before it leaves.
std::string assimpsCollada(std::string_view bytes, LeftOut& leftOut) {
    ShownCollada shown = shownCollada(tidyCollada(bytes));
    if (!shown.warning.empty()) leftOut.warnings.push_back(shown.warning);
    SettledCollada settled = settledCollada(withOwnIds(linkedCollada(std::move(shown.text))));
    leftOut.nodeNames = std::move(settled.names);
    leftOut.warnings.insert(leftOut.warnings.end(), settled.warnings.begin(), settled.warnings.end());
    StraightenedCollada curves = straightenedCollada(gatheredCollada(withOwnSamplers(withPlainParams(settled.text))));
    StraightenedCollada matrices = withWholeMatrices(std::move(curves.text));
    if (!curves.isWhole || !matrices.isWhole)
        leftOut.warnings.emplace_back("curves play straight from key to key, for the file holds too many of them");
    return std::move(matrices.text);
}

// Empty when the file is neither Collada nor B3D.
std::string tidiedBytes(const fs::path& file, LeftOut& leftOut) {
    std::string start(4096, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(in.gcount()));
    const bool collada = isCollada(start);
    if (!collada && !isB3d(start)) return {};
    const Result<std::vector<unsigned char>> bytes = readFile(file, kMaxFileBytes);
    if (!bytes) return {};
    const std::string_view whole(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
    if (!collada) return tidyB3d(whole);
    return assimpsCollada(whole, leftOut);
}

}  // namespace

ConfinedFiles::ConfinedFiles(fs::path model, ModelFolder folder, std::shared_ptr<LeftOut> leftOut)
    : model_(std::move(model)), folder_(std::move(folder)), leftOut_(std::move(leftOut)) {}

bool ConfinedFiles::mayOpen(const std::string& file) const {
    if (model_ == file) return true;
    std::error_code failed;
    if (!fs::exists(file, failed)) leftOut_->absent.insert(file);
    if (!folder_.admits(file)) {
        // Readers ask by a bare name, too, before they put the folder before it.
        const fs::path name = fs::path(file).lexically_normal();
        const bool isBare = name.is_relative() && *name.begin() != ".." && file.rfind(folder_.path().string(), 0) != 0;
        if (!isBare) leftOut_->outside.insert(file);
        return false;
    }
    return fs::is_regular_file(file, failed) && fs::file_size(file, failed) <= kMaxFileBytes && !failed;
}

bool ConfinedFiles::Exists(const char* file) const {
    return mayOpen(file) && DefaultIOSystem::Exists(file);
}

Assimp::IOStream* ConfinedFiles::Open(const char* file, const char* mode) {
    const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    if (!reads || !mayOpen(file)) return nullptr;
    if (Assimp::IOStream* tidied = model_ == file ? openTidied() : nullptr) return tidied;
    if (lowerCased(fs::path(file).extension().string()) == ".material") return openMaterial(file);
    return DefaultIOSystem::Open(file, mode);
}

// The model in memory when it is Collada or B3D; else nothing. Assimp opens it several times.
Assimp::IOStream* ConfinedFiles::openTidied() {
    if (!tidied_) tidied_ = tidiedBytes(model_, *leftOut_);
    if (tidied_->empty()) return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(tidied_->data()), tidied_->size());
}

Assimp::IOStream* ConfinedFiles::openMaterial(const std::string& file) {
    const Result<std::vector<unsigned char>> bytes = readFile(file, kMaxFileBytes);
    if (!bytes) return nullptr;
    const std::string text =
        tidyOgreMaterial({reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size()});
    auto* copy = new std::uint8_t[text.size()];  // which the stream owns
    std::copy(text.begin(), text.end(), copy);
    return new Assimp::MemoryIOStream(copy, text.size(), true);
}

bool ConfinedFiles::CreateDirectory(const std::string& /*path*/) {
    return false;
}

bool ConfinedFiles::DeleteFile(const std::string& /*file*/) {
    return false;
}

}  // namespace lutka::animation::rig_import
