#include "animation/import/source_reader.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "animation/import/assimp/collada_text.hpp"
#include "animation/import/assimp/read_with_assimp.hpp"
#include "animation/import/bvh/read_bvh.hpp"
#include "animation/import/clean_source.hpp"
#include "animation/import/fbx/document.hpp"
#include "animation/import/fbx/read_fbx.hpp"
#include "animation/import/gltf/read_gltf.hpp"
#include "animation/import/iqm/iqm_document.hpp"
#include "animation/import/iqm/read_iqm.hpp"
#include "animation/import/source_limits.hpp"
#include "animation/import/unread_format.hpp"
#include "core/input_file.hpp"
#include "core/letter_case.hpp"
#include "core/utf8.hpp"

namespace lutka::animation::rig_import {
namespace {

namespace fs = std::filesystem;

Error cannotRead(const fs::path& file, std::string message) {
    return {ErrorCode::input, std::move(message), file.string(), ""};
}

std::string firstBytes(const fs::path& file) {
    std::array<char, 512> bytes{};
    std::ifstream in(file, std::ios::binary);
    in.read(bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(in.gcount())};
}

std::string lowerExtension(const fs::path& file) {
    return lowerCased(file.extension().string());
}

// A binary container says so; a text is JSON under a name of glTF's (there are other formats in JSON).
bool isGltf(const fs::path& file, std::string_view start) {
    if (start.starts_with("glTF")) return true;
    const std::size_t first = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    const std::string extension = lowerExtension(file);
    if (isUtf16(start)) return extension == ".gltf";  // which no other format is
    return first != std::string_view::npos && start[first] == '{' &&
           (extension == ".gltf" || extension == ".glb" || extension == ".vrm");
}

bool isBvh(const fs::path& file, std::string_view start) {
    const std::size_t first = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return lowerExtension(file) == ".bvh" ||
           (first != std::string_view::npos && start.substr(first).starts_with("HIERARCHY"));
}

// Of the texts in UTF-16 those of Collada and glTF are read.
std::optional<Error> otherUtf16(const fs::path& file, std::string_view start) {
    if (!isUtf16(start) || isCollada(start)) return std::nullopt;
    return Error{ErrorCode::input, "is a text in UTF-16", file.string(), "save it as UTF-8, or export it again"};
}

Result<SourceScene> read(const fs::path& file, std::string_view start, const ImportOptions& options) {
    if (isGltf(file, start)) return readGltf(file, options);
    if (std::optional<Error> refusal = otherUtf16(file, start)) return *std::move(refusal);
    if (fbx::isFbx({reinterpret_cast<const std::uint8_t*>(start.data()), start.size()})) return readFbx(file, options);
    if (isBvh(file, start)) return readBvh(file);
    if (iqm::isIqm(start)) return readIqm(file, options);
    if (std::optional<Error> refusal = unreadFormat(file, start)) return *std::move(refusal);
    return readWithAssimp(file, options);
}

// Outside of glTF nothing says that vertex colours are colours: those that are black everywhere hold data in their
// alpha.
void forgetDataColors(SourceScene& scene) {
    for (SourceMesh& mesh : scene.meshes) {
        const auto isBlack = [](const vec4& color) { return color.r == 0.0F && color.g == 0.0F && color.b == 0.0F; };
        if (std::all_of(mesh.colors.begin(), mesh.colors.end(), isBlack)) mesh.colors.clear();
    }
}

}  // namespace

Result<SourceScene> readSource(const fs::path& file, const ImportOptions& options) {
    std::error_code ignored;
    const fs::file_status status = fs::status(file, ignored);
    if (!fs::exists(status)) return cannotRead(file, "there is no such file");
    if (fs::is_directory(status)) return cannotRead(file, "is a folder, not a model");
    if (!fs::is_regular_file(status)) return cannotRead(file, "is a device or a pipe, not a model");
    const Result<InputFile> opened = InputFile::open(file);
    if (!opened) return opened.error();  // third parties would not say why
    const std::size_t size = opened.value().size();
    if (size == 0) return cannotRead(file, "is empty");
    if (size > kMaxFileBytes) return tooLargeFile(file.string());
    const std::string start = firstBytes(file);
    // Third parties throw; what is left is memory running out over a monstrous file.
    try {
        Result<SourceScene> scene = read(file, start, options);
        if (scene && !isGltf(file, start)) forgetDataColors(scene.value());
        if (scene) cleanNumbers(scene.value());
        return scene;
    } catch (const std::exception& e) {
        return cannotRead(file, std::string("can't be imported: ") + e.what());
    }
}

}  // namespace lutka::animation::rig_import
