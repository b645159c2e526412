#include "model_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "animation/import/build_character.hpp"
#include "animation/import/clean_source.hpp"
#include "animation/import/scene_blob.hpp"
#include "fuzz/fuzz_target.hpp"

namespace lutka::fuzz {

namespace rig_import = animation::rig_import;

ModelFile::ModelFile(const std::uint8_t* data, std::size_t size) : handle_(::memfd_create("model", MFD_CLOEXEC)) {
    promise(handle_ >= 0 && ::write(handle_, data, size) == static_cast<ssize_t>(size));
}

ModelFile::~ModelFile() {
    ::close(handle_);
}

std::filesystem::path ModelFile::path() const {
    return "/proc/self/fd/" + std::to_string(handle_);
}

void promiseSoundImport(Result<rig_import::SourceScene> scene) {
    if (!scene) return;
    rig_import::cleanNumbers(scene.value());
    Result<rig_import::SourceScene> taken = rig_import::unpackScene(rig_import::packScene(scene), "fuzz");
    promise(taken.ok());  // our own readers give no scene that the other side refuses
    const auto character = rig_import::buildCharacter(std::move(taken).value(), "fuzz.glb", {});
    if (!character) return;
    promise(animation::validate(character.value().skeleton).empty());
    for (const animation::SkinnedMesh& mesh : character.value().meshes) {
        for (const std::uint32_t index : mesh.indices)
            promise(index < mesh.positions.size());
        for (const vec3& position : mesh.positions)
            promise(isFinite(position));
        for (const vec3& normal : mesh.normals)
            promise(isFinite(normal));
    }
    constexpr std::size_t mostFrames = 20000;  // to be looked at: posing long clips takes the time of a hundred files
    for (const animation::Clip& clip : character.value().clips) {
        if (clip.parentFromJoint.size() > mostFrames) continue;
        for (const RigidTransform& frame : clip.parentFromJoint)
            promise(isFinite(frame));
    }
}

}  // namespace lutka::fuzz
