#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/files.hpp"
#include "core/json/json_text.hpp"
#include "core/letter_case.hpp"
#include "scene/description/scene_file.hpp"
#include "scene/description/scene_format.hpp"

namespace lutka::scene {
namespace {

using Json = nlohmann::ordered_json;

template <class Enum, std::size_t count>
const char* nameOf(const std::array<scene_format::Named<Enum>, count>& table, Enum value) {
    return std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.value == value; })->name;
}

std::string hexOf(const render::Color& color) {
    return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

// As a file in `folder` names it; what lies on another drive stays absolute.
std::string pathFrom(const std::filesystem::path& path, const std::filesystem::path& folder) {
    namespace fs = std::filesystem;
    if (path.empty()) return {};
    std::error_code failed;
    const fs::path base = fs::weakly_canonical(folder.empty() ? "." : folder, failed);
    const fs::path target = fs::weakly_canonical(path, failed);
    const fs::path relative = target.lexically_relative(base);
    return (relative.empty() ? target : relative).generic_string();
}

Json toJson(const Transform& t) {
    return Json{{"rotation", jsonQuaternion(t.parentFromEntity.rotation)},
                {"translation", jsonVector(t.parentFromEntity.translation)}};
}

Json toJson(const MeshRenderer& m) {
    return Json{{"color", hexOf(m.color)},
                {"opacity", jsonNumber(m.opacity)},
                {"visible", m.visible},
                {"castsShadow", m.castsShadow}};
}

Json toJson(const RigidBody& b) {
    return Json{{"massKg", jsonNumber(b.massKg)},
                {"linearVelocity", jsonVector(b.linearVelocity)},
                {"angularVelocity", jsonVector(b.angularVelocity)}};
}

// Only what the kind has a use for.
Json toJson(const Collider& c) {
    Json out{{"kind", nameOf(scene_format::kColliderKinds, c.kind)}};
    switch (c.kind) {
        case Collider::Kind::plane:
            break;
        case Collider::Kind::box:
            out["halfExtents"] = jsonVector(c.halfExtents);
            break;
        case Collider::Kind::sphere:
            out["radius"] = jsonNumber(c.radius);
            break;
        case Collider::Kind::capsule:
            out["radius"] = jsonNumber(c.radius);
            out["halfLength"] = jsonNumber(c.halfLength);
            break;
        case Collider::Kind::ramp:
            out["width"] = jsonNumber(c.width);
            out["length"] = jsonNumber(c.length);
            out["angle"] = jsonNumber(c.angle);
            break;
        case Collider::Kind::stairs:
            out["width"] = jsonNumber(c.width);
            out["steps"] = c.steps;
            out["rise"] = jsonNumber(c.rise);
            out["run"] = jsonNumber(c.run);
            out["landing"] = jsonNumber(c.length);
            break;
    }
    out["friction"] = jsonNumber(c.friction);
    return out;
}

Json toJson(const Ragdoll& r, const std::filesystem::path& folder) {
    Json out = Json::object();
    if (!r.model.empty()) out["model"] = pathFrom(r.model, folder);
    if (r.figure) out["figure"] = *r.figure;
    if (!r.profile.empty()) out["profile"] = pathFrom(r.profile, folder);
    if (r.rig) out["rig"] = nameOf(scene_format::kRigs, *r.rig);
    if (r.pose) out["pose"] = nameOf(scene_format::kPoses, *r.pose);
    if (r.clip) out["clip"] = Json{{"name", r.clip->clip}, {"seconds", jsonNumber(r.clip->seconds)}};
    if (!r.pins.empty()) out["pins"] = r.pins;
    out["linearVelocity"] = jsonVector(r.linearVelocity);
    out["angularVelocity"] = jsonVector(r.angularVelocity);
    if (r.strength != 1.0F) out["strength"] = jsonNumber(r.strength);
    for (const RagdollHit& hit : r.hits) {
        out["hits"].push_back(Json{{"body", animation::roleName(hit.body)},
                                   {"seconds", jsonNumber(hit.seconds)},
                                   {"impulse", jsonVector(hit.impulse)}});
    }
    return out;
}

Json toJson(const ScenePuppets& p) {
    Json out{{"clip", p.clip}};
    if (p.muscles) out["muscles"] = nameOf(scene_format::kMuscles, *p.muscles);
    out["strength"] = jsonNumber(p.strength);
    if (p.pinForceN) out["pinForceN"] = jsonNumber(*p.pinForceN);
    if (!p.kinematic.empty()) {
        out["kinematic"] = Json::array();
        for (const LedPart& part : p.kinematic)
            out["kinematic"].push_back(Json{{"part", part.name}, {"weight", jsonNumber(part.weight)}});
    }
    out["getUp"] = p.getUp;
    out["limp"] = p.limp;
    out["pace"] = jsonNumber(p.pace);
    return out;
}

Json toJson(const Light& l) {
    Json out{{"kind", nameOf(scene_format::kLightKinds, l.kind)},
             {"color", jsonVector(l.color)},
             {"intensity", jsonNumber(l.intensity)}};
    if (l.kind == Light::Kind::sun) {
        out["angularRadius"] = jsonNumber(l.angularRadius);
        out["castsShadow"] = l.castsShadow;
        return out;
    }
    out["range"] = jsonNumber(l.range);
    if (l.kind == Light::Kind::spot) {
        out["outerAngle"] = jsonNumber(l.outerAngle);
        out["innerAngle"] = jsonNumber(l.innerAngle);
    }
    return out;
}

Json toJson(const Camera& c) {
    return Json{{"fieldOfView", jsonNumber(c.fieldOfView)},
                {"distance", jsonNumber(c.distance)},
                {"orthographic", c.orthographic},
                {"active", c.active}};
}

Json toJson(const SceneSimulation& s) {
    const physics::WorldSettings& world = s.world;
    Json out{{"solver", physics::solverName(world.solver)},
             {"gravity", jsonVector(world.gravity)},
             {"step", jsonNumber(s.dt)},
             {"seconds", jsonNumber(s.seconds)},
             {"threads", world.threads},
             {"sleeping", world.sleeping},
             {"seed", s.seed}};
    if (world.substeps) out["substeps"] = *world.substeps;
    if (world.iterations) out["iterations"] = *world.iterations;
    if (world.linearDamping) out["linearDamping"] = jsonNumber(*world.linearDamping);
    if (world.angularDamping) out["angularDamping"] = jsonNumber(*world.angularDamping);
    out["focus"] = jsonVector(s.focus);
    out["focusRadius"] = jsonNumber(s.focusRadius);
    const SceneSimulation plain;
    if (s.focusYaw != plain.focusYaw) out["focusYaw"] = jsonNumber(s.focusYaw);
    if (s.focusPitch != plain.focusPitch) out["focusPitch"] = jsonNumber(s.focusPitch);
    if (s.focusFollows) out["focusFollows"] = true;
    if (s.puppets) out["puppets"] = toJson(*s.puppets);
    return out;
}

Json toJson(const EntityScene& scene, const Entity& entity, const std::filesystem::path& folder) {
    Json out{{"id", entity.id}, {"name", entity.name}};
    if (entity.parent != kNoEntity) out["parent"] = entity.parent;
    const auto put = [&](const char* key, const auto* component) {
        if (component != nullptr) out[key] = toJson(*component);
    };
    put("transform", scene.find<Transform>(entity.id));
    put("meshRenderer", scene.find<MeshRenderer>(entity.id));
    put("rigidBody", scene.find<RigidBody>(entity.id));
    put("collider", scene.find<Collider>(entity.id));
    if (const Ragdoll* ragdoll = scene.find<Ragdoll>(entity.id)) out["ragdoll"] = toJson(*ragdoll, folder);
    put("light", scene.find<Light>(entity.id));
    put("camera", scene.find<Camera>(entity.id));
    return out;
}

}  // namespace

bool isSceneFile(const std::filesystem::path& file) {
    return lowerCased(file.filename().string()).ends_with(scene_format::kExtension);
}

std::string sceneToJson(const EntityScene& scene, const std::filesystem::path& folder) {
    Json out{{"$schema", scene_format::kSchema},
             {"format", scene_format::kName},
             {"version", EntityScene::kVersion},
             {"name", scene.name},
             {"simulation", toJson(scene.simulation)}};
    out["entities"] = Json::array();
    for (const Entity& entity : scene.entities)
        out["entities"].push_back(toJson(scene, entity, folder));
    return jsonText(out);
}

Result<void> saveScene(const std::filesystem::path& file, const EntityScene& scene) {
    return writeFileAtomically(file, sceneToJson(scene, file.parent_path()));
}

}  // namespace lutka::scene
