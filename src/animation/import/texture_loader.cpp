#include "animation/import/texture_loader.hpp"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <system_error>

#include "core/files.hpp"

namespace lutka::animation::rig_import {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxSide = 16384;
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30U;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

// "%20" and the like, as URIs in glTF write them.
std::string decodePercents(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '%' && i + 2 < text.size() &&
                            std::isxdigit(static_cast<unsigned char>(text[i + 1])) != 0 &&
                            std::isxdigit(static_cast<unsigned char>(text[i + 2])) != 0;
        if (escape) {
            out += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

std::optional<fs::path> findIn(const fs::path& folder, const std::string& name) {
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        if (lower(at->path().filename().string()) == lower(name) && at->is_regular_file(failed)) return at->path();
    }
    return std::nullopt;
}

// Of a path in any spelling, Windows' too.
std::string extensionOf(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    return fs::path(path).extension().string();
}

// The picture of that name in one of the folders where exporters put them.
std::optional<fs::path> findAround(const fs::path& folder, const std::string& name) {
    const fs::path above = folder / "..";
    for (const fs::path& place :
         {folder, folder / "textures", folder / "Textures", folder / "tex", above / "textures", above / "Textures"}) {
        if (auto found = findIn(place, name)) return found;
    }
    return std::nullopt;
}

std::optional<fs::path> findPicture(const fs::path& folder, std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    for (const std::string& spelling : {path, decodePercents(path)}) {
        const fs::path written(spelling);
        const bool windowsDrive = spelling.size() > 1 && spelling[1] == ':';
        std::error_code ignored;
        if (written.is_relative() && !windowsDrive && fs::is_regular_file(folder / written, ignored))
            return folder / written;
        const std::string name = written.filename().string();
        if (name.empty()) continue;
        if (auto found = findAround(folder, name)) return found;
    }
    // A model is often handed on with its pictures converted.
    const std::string stem = fs::path(decodePercents(path)).stem().string();
    if (stem.empty()) return std::nullopt;
    for (const char* ending : {".png", ".jpg", ".jpeg", ".tga", ".bmp"}) {
        if (auto found = findAround(folder, stem + ending)) return found;
    }
    return std::nullopt;
}

}  // namespace

std::optional<Texture> decodePicture(std::span<const std::uint8_t> bytes) {
    const int length = static_cast<int>(std::min(bytes.size(), kMaxFileBytes));
    Texture texture;
    int channels = 0;
    if (stbi_info_from_memory(bytes.data(), length, &texture.width, &texture.height, &channels) == 0)
        return std::nullopt;
    if (texture.width <= 0 || texture.height <= 0 || texture.width > kMaxSide || texture.height > kMaxSide)
        return std::nullopt;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), length, &texture.width, &texture.height, &channels, 4), stbi_image_free);
    if (!pixels) return std::nullopt;
    const std::size_t count =
        std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
    texture.rgba.assign(pixels.get(), pixels.get() + count);
    return texture;
}

TextureLoader::TextureLoader(Embedded embedded, const fs::path& model, bool enabled)
    : embedded_(std::move(embedded)),
      folder_(model.has_parent_path() ? model.parent_path() : fs::path(".")),
      enabled_(enabled) {}

int TextureLoader::load(const std::string& path) {
    if (!enabled_) return Material::kNoTexture;
    if (const auto known = known_.find(path); known != known_.end()) return known->second;
    return keep(path, decode(path));
}

int TextureLoader::load(const std::string& path, std::span<const std::uint8_t> embedded) {
    if (!enabled_) return Material::kNoTexture;
    if (embedded.empty()) return load(path);
    std::optional<Texture> texture = decodePicture(embedded);
    if (!texture) return load(path);
    texture->name = path;
    return keep(path, std::move(texture));
}

int TextureLoader::keep(const std::string& path, std::optional<Texture> texture) {
    int index = Material::kNoTexture;
    if (texture) {
        index = static_cast<int>(textures_.size());
        textures_.push_back(*std::move(texture));
    } else {
        missing_.push_back(path);
    }
    known_[path] = index;
    return index;
}

std::optional<Texture> TextureLoader::decode(const std::string& path) {
    if (std::optional<Texture> embedded = embedded_(path)) return embedded;
    const std::optional<fs::path> file = findPicture(folder_, path);
    if (!file) return std::nullopt;
    const Result<std::vector<unsigned char>> bytes = readFile(*file, kMaxFileBytes);
    if (!bytes) return std::nullopt;
    std::optional<Texture> texture = decodePicture(bytes.value());
    if (!texture) return std::nullopt;
    texture->name = file->filename().string();
    if (lower(file->extension().string()) != lower(extensionOf(path)))
        replaced_.push_back(fmt::format("{} for {}", texture->name, path));
    return texture;
}

std::vector<std::string> TextureLoader::sentences() const {
    std::vector<std::string> out;
    if (!missing_.empty()) {
        out.push_back(fmt::format("{} pictures were not found or can't be decoded and were left out: {}",
                                  missing_.size(), fmt::join(missing_, ", ")));
    }
    if (!replaced_.empty()) {
        out.push_back(
            fmt::format("pictures of the same name with another ending were taken: {}", fmt::join(replaced_, ", ")));
    }
    return out;
}

}  // namespace lutka::animation::rig_import
