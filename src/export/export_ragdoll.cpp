#include "export/export_ragdoll.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/letter_case.hpp"
#include "export/write_blender.hpp"
#include "export/write_bullet.hpp"
#include "export/write_gltf.hpp"
#include "export/write_godot.hpp"
#include "export/write_mjcf.hpp"
#include "export/write_urdf.hpp"
#include "export/write_usd.hpp"

namespace lutka::exporting {
namespace {

constexpr std::array kFormats{
    ExportFormatInfo{ExportFormat::mjcf, "mjcf", ".xml", "MuJoCo (Isaac and Newton import it)"},
    ExportFormatInfo{ExportFormat::glb, "glb", ".glb", "glTF with KHR_physics_rigid_bodies, experimental"},
    ExportFormatInfo{ExportFormat::gltf, "gltf", ".gltf", "the same as one text file"},
    ExportFormatInfo{ExportFormat::godot4, "godot", ".tscn", "a scene of Godot 4"},
    ExportFormatInfo{ExportFormat::godot3, "godot3", ".tscn", "a scene of Godot 3"},
    ExportFormatInfo{ExportFormat::blender, "blender", ".py", "a script that builds it in Blender"},
    ExportFormatInfo{ExportFormat::urdf, "urdf", ".urdf", "a robot of ROS"},
    ExportFormatInfo{ExportFormat::bullet, "bullet", ".cpp", "C++ that builds it with plain Bullet"},
    ExportFormatInfo{ExportFormat::usd, "usd", ".usda", "UsdPhysics, unverified"},
};

bool endsWith(const std::string& text, std::string_view ending) {
    return text.size() > ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

// A capsule without a length is a sphere: MuJoCo refuses it otherwise, and others have no cylinder of length 0.
physics::RagdollProfile withSpheres(physics::RagdollProfile profile) {
    constexpr float kNoLength = 1e-5F;  // metres
    const auto settle = [](physics::PrimitiveShape& shape) {
        using Kind = physics::PrimitiveShape::Kind;
        if (shape.kind == Kind::capsule && shape.halfLength < kNoLength) shape.kind = Kind::sphere;
    };
    for (physics::BodyProfile& body : profile.bodies) {
        settle(body.shape);
        for (physics::AddedShape& added : body.shape.more)
            settle(added);
    }
    return profile;
}

Result<Exported> writeAs(ExportFormat format, const ExportSource& source) {
    switch (format) {
        case ExportFormat::mjcf:
            return writeMjcf(source);
        case ExportFormat::glb:
            return writeGltf(source, GltfKind::binary);
        case ExportFormat::gltf:
            return writeGltf(source, GltfKind::text);
        case ExportFormat::godot4:
            return writeGodot(source, GodotVersion::four);
        case ExportFormat::godot3:
            return writeGodot(source, GodotVersion::three);
        case ExportFormat::blender:
            return writeBlender(source);
        case ExportFormat::urdf:
            return writeUrdf(source);
        case ExportFormat::bullet:
            return writeBullet(source);
        case ExportFormat::usd:
            return writeUsd(source);
    }
    return Error{ErrorCode::internal, "there is no writer for this format", "", ""};
}

}  // namespace

std::span<const ExportFormatInfo> exportFormats() {
    return kFormats;
}

std::optional<ExportFormat> exportFormatNamed(std::string_view name) {
    for (const ExportFormatInfo& info : kFormats)
        if (info.name == name) return info.format;
    return std::nullopt;
}

std::optional<ExportFormat> exportFormatOf(const std::filesystem::path& file) {
    const std::string name = lowerCased(file.filename().string());
    for (const ExportFormatInfo& info : kFormats)
        if (endsWith(name, info.ending)) return info.format;
    return std::nullopt;
}

Result<Exported> exportRagdoll(ExportFormat format, const ExportSource& source) {
    const physics::RagdollProfile profile = withSpheres(source.profile);
    auto written = writeAs(format, {source.character, profile, source.rig});
    const auto& constraints = profile.constraints;
    const auto springs = std::count_if(constraints.begin(), constraints.end(),
                                       [](const physics::ConstraintProfile& c) { return c.spring.works(); });
    if (written && springs > 0) {
        written.value().warnings.push_back(fmt::format("the springs (stiffness and damping) of {} joint{} are left out",
                                                       springs, springs == 1 ? "" : "s"));
    }
    return written;
}

}  // namespace lutka::exporting
