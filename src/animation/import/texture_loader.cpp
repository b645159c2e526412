#include "animation/import/texture_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "animation/import/uri.hpp"
#include "core/files.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {
namespace {

namespace fs = std::filesystem;

// Of a path in any spelling, Windows' too.
std::string extensionOf(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    return fs::path(path).extension().string();
}

// The picture of that name in one of the folders where exporters put them.
std::optional<fs::path> findAround(const ModelFolder& folder, const std::string& name) {
    const fs::path above = folder.path() / "..";
    for (const fs::path& place : {folder.path(), folder.path() / "textures", folder.path() / "Textures",
                                  folder.path() / "tex", above / "textures", above / "Textures"}) {
        if (fs::path found = folder.fileIn(place, name); !found.empty()) return found;
    }
    return std::nullopt;
}

ModelFolder::Named findPicture(const ModelFolder& folder, std::string path) {
    using Place = ModelFolder::Place;
    std::replace(path.begin(), path.end(), '\\', '/');
    bool outside = false;
    for (const std::string& spelling : {path, decodePercents(path)}) {
        ModelFolder::Named named = folder.find(spelling);
        if (named.place == Place::inside) return named;
        outside = outside || named.place == Place::outside;
        const std::string name = fs::path(spelling).filename().string();
        if (name.empty()) continue;
        if (auto found = findAround(folder, name)) return {Place::inside, *found};
    }
    // A model is often handed on with its pictures converted.
    const std::string stem = fs::path(decodePercents(path)).stem().string();
    for (const char* ending : {".png", ".jpg", ".jpeg", ".tga", ".bmp"}) {
        if (stem.empty()) break;
        if (auto found = findAround(folder, stem + ending)) return {Place::inside, *found};
    }
    return {outside ? Place::outside : Place::missing, {}};
}

}  // namespace

TextureLoader::TextureLoader(Embedded embedded, ModelFolder folder, bool enabled)
    : embedded_(std::move(embedded)), folder_(std::move(folder)), enabled_(enabled) {}

int TextureLoader::load(const std::string& path) {
    if (!enabled_) return Material::kNoTexture;
    if (const auto known = known_.find(path); known != known_.end()) return known->second;
    return keep(path, read(path));
}

int TextureLoader::load(const std::string& path, std::span<const std::uint8_t> embedded) {
    if (!enabled_) return Material::kNoTexture;
    if (embedded.empty()) return load(path);
    PictureDecoder::Decoded picture = decoder_.decode(embedded, path);
    if (picture.outcome == PictureDecoder::Outcome::damaged) return load(path);
    picture.texture.name = path;
    return keep(path, std::move(picture));
}

int TextureLoader::keep(const std::string& path, PictureDecoder::Decoded picture) {
    int index = Material::kNoTexture;
    if (picture.outcome == PictureDecoder::Outcome::decoded) {
        index = static_cast<int>(textures_.size());
        textures_.push_back(std::move(picture.texture));
    } else if (picture.outcome == PictureDecoder::Outcome::damaged &&
               std::find(outside_.begin(), outside_.end(), path) == outside_.end()) {
        missing_.push_back(path);
    }
    known_[path] = index;
    return index;
}

PictureDecoder::Decoded TextureLoader::read(const std::string& path) {
    if (std::optional<PictureDecoder::Decoded> embedded = embedded_(path, decoder_)) return *std::move(embedded);
    const ModelFolder::Named found = findPicture(folder_, path);
    if (found.place == ModelFolder::Place::outside) outside_.push_back(path);
    if (found.place != ModelFolder::Place::inside) return {};
    const Result<std::vector<unsigned char>> bytes = readFile(found.file, decoder_.limits().mostFileBytes);
    if (!bytes) return {};
    PictureDecoder::Decoded picture = decoder_.decode(bytes.value(), path);
    picture.texture.name = found.file.filename().string();
    if (picture.outcome == PictureDecoder::Outcome::decoded &&
        lowerCased(found.file.extension().string()) != lowerCased(extensionOf(path)))
        replaced_.push_back(fmt::format("{} for {}", picture.texture.name, path));
    return picture;
}

// Packages from the net often have `source/model.fbx` beside `textures/`.
std::string TextureLoader::hintAbove() const {
    if (folder_.allowsOutside()) return {};
    std::error_code failed;
    for (const char* name : {"textures", "Textures"}) {
        if (fs::is_directory(folder_.path() / ".." / name, failed))
            return fmt::format("; --allow-outside looks into ../{}, too", name);
    }
    return {};
}

namespace {

std::string picturesWere(std::size_t count) {
    return count == 1 ? "1 picture was" : fmt::format("{} pictures were", count);
}

}  // namespace

std::vector<std::string> TextureLoader::sentences() const {
    std::vector<std::string> out = decoder_.sentences();
    if (!missing_.empty()) {
        out.push_back(fmt::format("{} not found or can't be decoded and left out: {}{}", picturesWere(missing_.size()),
                                  fmt::join(missing_, ", "), hintAbove()));
    }
    if (!outside_.empty()) {
        out.push_back(
            fmt::format("{} outside of the model's folder and left out: {}; put what is missing beside the model, or "
                        "--allow-outside takes it",
                        picturesWere(outside_.size()), fmt::join(outside_, ", ")));
    }
    if (!replaced_.empty()) {
        out.push_back(
            fmt::format("pictures of the same name with another ending were taken: {}", fmt::join(replaced_, ", ")));
    }
    return out;
}

}  // namespace lutka::animation::rig_import
