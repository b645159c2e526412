#include <fmt/format.h>

#include <algorithm>

#include "core/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "scene/description/scene_file.hpp"
#include "scene/description/scene_format.hpp"

namespace lutka::scene {
namespace {

using nlohmann::json;

constexpr float kAny = 1e9F;  // what a number may be at all; validate() knows each one's range

// Every member but a few may be left out and has then its default. What can't be read is reported and left as it was,
// so that one mistake is one problem.
void take(const JsonCursor& at, const char* key, float& value) {
    if (!at.has(key)) return;
    const JsonCursor member = at[key];
    const float read = member.number(-kAny, kAny);
    if (member.readable()) value = read;
}

void take(const JsonCursor& at, const char* key, vec3& value) {
    if (!at.has(key)) return;
    const JsonCursor member = at[key];
    const std::vector<float> read = member.numbers(3, -kAny, kAny);
    if (member.readable()) value = {read[0], read[1], read[2]};
}

void take(const JsonCursor& at, const char* key, quat& value) {
    if (!at.has(key)) return;
    const JsonCursor member = at[key];
    const std::vector<float> read = member.numbers(4, -kAny, kAny);
    if (member.readable()) value = quat(read[3], read[0], read[1], read[2]);
}

void take(const JsonCursor& at, const char* key, std::string& value) {
    if (!at.has(key)) return;
    const JsonCursor member = at[key];
    std::string read = member.text();
    if (member.readable()) value = std::move(read);
}

void take(const JsonCursor& at, const char* key, bool& value) {
    if (!at.has(key)) return;
    if (const auto read = at[key].truth()) value = *read;
}

template <class Whole>
void takeWhole(const JsonCursor& at, const char* key, Whole& value, long long low, long long high) {
    if (!at.has(key)) return;
    if (const auto read = at[key].wholeNumber(low, high)) value = static_cast<Whole>(*read);
}

// One of the words of a table.
template <class Entry, std::size_t count, class Enum, class Name, class Value>
void takeEntry(const JsonCursor& at, const char* key, const std::array<Entry, count>& table, Enum& value,
               const Name& name, const Value& meaning) {
    if (!at.has(key)) return;
    std::array<const char*, count> names{};
    std::transform(table.begin(), table.end(), names.begin(), name);
    const int index = at[key].oneOf(names);
    if (index >= 0) value = meaning(table[index]);
}

template <class Enum, std::size_t count>
void takeName(const JsonCursor& at, const char* key, const std::array<scene_format::Named<Enum>, count>& table,
              Enum& value) {
    using NamedValue = scene_format::Named<Enum>;
    takeEntry(
        at, key, table, value, [](const NamedValue& entry) { return entry.name; },
        [](const NamedValue& entry) { return entry.value; });
}

void takeName(const JsonCursor& at, const char* key, physics::SolverKind& value) {
    using Solver = physics::SolverEntry;
    takeEntry(
        at, key, physics::kSolvers, value, [](const Solver& entry) { return entry.name; },
        [](const Solver& entry) { return entry.kind; });
}

void takeOptional(const JsonCursor& at, const char* key, std::optional<float>& value) {
    if (!at.has(key)) return;
    const JsonCursor member = at[key];
    const float read = member.number(-kAny, kAny);
    if (member.readable()) value = read;
}

void takeOptional(const JsonCursor& at, const char* key, std::optional<int>& value) {
    constexpr int nothing = 0;  // is no count of substeps or passes
    int read = nothing;
    takeWhole(at, key, read, 1, 1000);
    if (read != nothing) value = read;
}

void takeColor(const JsonCursor& at, const char* key, render::Color& value) {
    if (!at.has(key)) return;
    const JsonCursor member = at[key];
    const std::string text = member.text();
    if (!member.readable()) return;
    const bool hex =
        text.size() == 7 && text[0] == '#' && text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!hex) {
        member.report("expected a colour \"#rrggbb\" in hexadecimal digits, got \"" + text + "\"");
        return;
    }
    const auto channel = [&](std::size_t first) {
        return static_cast<std::uint8_t>(std::stoi(text.substr(first, 2), nullptr, 16));
    };
    value = {channel(1), channel(3), channel(5), 255};
}

void takePath(const JsonCursor& at, const char* key, const std::filesystem::path& folder,
              std::filesystem::path& value) {
    if (!at.has(key)) return;
    const JsonCursor member = at[key];
    const std::string text = member.text();
    if (!member.readable()) return;
    if (text.empty() || text.find('\0') != std::string::npos) {
        member.report("expected the path of a file; leave the member out for none");
        return;
    }
    const std::filesystem::path path(text);
    value = path.is_absolute() ? path : (folder / path).lexically_normal();
}

Transform readTransform(const JsonCursor& at) {
    at.expectObject({}, {"rotation", "translation"});
    Transform out;
    take(at, "rotation", out.parentFromEntity.rotation);
    take(at, "translation", out.parentFromEntity.translation);
    return out;
}

MeshRenderer readMeshRenderer(const JsonCursor& at) {
    at.expectObject({}, {"color", "opacity", "visible", "castsShadow"});
    MeshRenderer out;
    takeColor(at, "color", out.color);
    take(at, "opacity", out.opacity);
    take(at, "visible", out.visible);
    take(at, "castsShadow", out.castsShadow);
    return out;
}

RigidBody readRigidBody(const JsonCursor& at) {
    at.expectObject({}, {"massKg", "linearVelocity", "angularVelocity"});
    RigidBody out;
    take(at, "massKg", out.massKg);
    take(at, "linearVelocity", out.linearVelocity);
    take(at, "angularVelocity", out.angularVelocity);
    return out;
}

Collider readCollider(const JsonCursor& at) {
    Collider out;
    takeName(at, "kind", scene_format::kColliderKinds, out.kind);
    switch (out.kind) {
        case Collider::Kind::plane:
            at.expectObject({"kind"}, {"friction"});
            break;
        case Collider::Kind::box:
            at.expectObject({"kind"}, {"halfExtents", "friction"});
            break;
        case Collider::Kind::sphere:
            at.expectObject({"kind"}, {"radius", "friction"});
            break;
        case Collider::Kind::capsule:
            at.expectObject({"kind"}, {"radius", "halfLength", "friction"});
            break;
        case Collider::Kind::ramp:
            at.expectObject({"kind"}, {"width", "length", "angle", "friction"});
            break;
        case Collider::Kind::stairs:
            at.expectObject({"kind"}, {"width", "steps", "rise", "run", "landing", "friction"});
            take(at, "landing", out.length);
            break;
    }
    take(at, "halfExtents", out.halfExtents);
    take(at, "radius", out.radius);
    take(at, "halfLength", out.halfLength);
    take(at, "width", out.width);
    take(at, "length", out.length);
    take(at, "angle", out.angle);
    takeWhole(at, "steps", out.steps, 1, 200);
    take(at, "rise", out.rise);
    take(at, "run", out.run);
    take(at, "friction", out.friction);
    return out;
}

RagdollHit readHit(const JsonCursor& at) {
    at.expectObject({"body", "seconds", "impulse"});
    RagdollHit out;
    const std::string name = at["body"].text();
    const auto role = animation::roleFromName(name);
    if (role) out.body = *role;
    if (at["body"].readable() && !role)
        at["body"].report("expected a role of the VRM 1.0 humanoid, got \"" + name + "\"");
    take(at, "seconds", out.seconds);
    take(at, "impulse", out.impulse);
    return out;
}

Ragdoll readRagdoll(const JsonCursor& at, const std::filesystem::path& folder) {
    at.expectObject({}, {"model", "figure", "profile", "rig", "pose", "clip", "pins", "linearVelocity",
                         "angularVelocity", "strength", "hits"});
    Ragdoll out;
    takePath(at, "model", folder, out.model);
    if (at.has("figure")) takeWhole(at, "figure", out.figure.emplace(1), 1, scene_format::kMostFigures);
    takePath(at, "profile", folder, out.profile);
    if (at.has("rig")) {
        physics::RigKind rig = physics::RigKind::humanoid;
        takeName(at, "rig", scene_format::kRigs, rig);
        out.rig = rig;
    }
    if (at.has("pose")) {
        StartPose pose = StartPose::bind;
        takeName(at, "pose", scene_format::kPoses, pose);
        out.pose = pose;
    }
    if (at.has("clip")) {
        const JsonCursor clip = at["clip"];
        clip.expectObject({"name"}, {"seconds"});
        out.clip.emplace();
        take(clip, "name", out.clip->clip);
        take(clip, "seconds", out.clip->seconds);
    }
    if (at.has("pins") && at["pins"].expectArray(0, physics::RagdollProfile::kMostBodies)) {
        const JsonCursor pins = at["pins"];
        for (std::size_t i = 0; i < pins.size(); ++i)
            out.pins.push_back(pins[i].text());
    }
    take(at, "linearVelocity", out.linearVelocity);
    take(at, "angularVelocity", out.angularVelocity);
    take(at, "strength", out.strength);
    if (at.has("hits") && at["hits"].expectArray(0, scene_format::kMostHits)) {
        const JsonCursor hits = at["hits"];
        for (std::size_t i = 0; i < hits.size(); ++i)
            out.hits.push_back(readHit(hits[i]));
    }
    return out;
}

// A list, for of parts that overlap the last one counts.
void readLed(const JsonCursor& at, std::vector<LedPart>& out) {
    if (!at.expectArray(0, physics::RagdollProfile::kMostBodies)) return;
    for (std::size_t i = 0; i < at.size(); ++i) {
        at[i].expectObject({"part"}, {"weight"});
        LedPart& part = out.emplace_back();
        take(at[i], "part", part.name);
        take(at[i], "weight", part.weight);
    }
}

void readPuppets(const JsonCursor& at, ScenePuppets& out) {
    at.expectObject({}, {"clip", "muscles", "strength", "pinForceN", "kinematic", "getUp", "limp", "pace"});
    take(at, "clip", out.clip);
    if (at.has("muscles")) takeName(at, "muscles", scene_format::kMuscles, out.muscles.emplace());
    take(at, "strength", out.strength);
    takeOptional(at, "pinForceN", out.pinForceN);
    if (at.has("kinematic")) readLed(at["kinematic"], out.kinematic);
    take(at, "getUp", out.getUp);
    take(at, "limp", out.limp);
    take(at, "pace", out.pace);
}

Light readLight(const JsonCursor& at) {
    Light out;
    takeName(at, "kind", scene_format::kLightKinds, out.kind);
    switch (out.kind) {
        case Light::Kind::sun:
            at.expectObject({"kind"}, {"color", "intensity", "angularRadius", "castsShadow"});
            break;
        case Light::Kind::point:
            at.expectObject({"kind"}, {"color", "intensity", "range"});
            break;
        case Light::Kind::spot:
            at.expectObject({"kind"}, {"color", "intensity", "range", "outerAngle", "innerAngle"});
            break;
    }
    take(at, "color", out.color);
    take(at, "intensity", out.intensity);
    take(at, "angularRadius", out.angularRadius);
    take(at, "castsShadow", out.castsShadow);
    take(at, "range", out.range);
    take(at, "outerAngle", out.outerAngle);
    take(at, "innerAngle", out.innerAngle);
    return out;
}

Camera readCamera(const JsonCursor& at) {
    at.expectObject({}, {"fieldOfView", "distance", "orthographic", "active"});
    Camera out;
    take(at, "fieldOfView", out.fieldOfView);
    take(at, "distance", out.distance);
    take(at, "orthographic", out.orthographic);
    take(at, "active", out.active);
    return out;
}

void readSimulation(const JsonCursor& at, SceneSimulation& out) {
    at.expectObject({}, {"solver", "gravity", "step", "seconds", "threads", "sleeping", "seed", "substeps",
                         "iterations", "linearDamping", "angularDamping", "focus", "focusRadius", "focusYaw",
                         "focusPitch", "focusFollows", "puppets"});
    takeName(at, "solver", out.world.solver);
    take(at, "gravity", out.world.gravity);
    take(at, "step", out.dt);
    take(at, "seconds", out.seconds);
    takeWhole(at, "threads", out.world.threads, 1, 256);
    take(at, "sleeping", out.world.sleeping);
    takeWhole(at, "seed", out.seed, 0, INT64_MAX);
    takeOptional(at, "substeps", out.world.substeps);
    takeOptional(at, "iterations", out.world.iterations);
    takeOptional(at, "linearDamping", out.world.linearDamping);
    takeOptional(at, "angularDamping", out.world.angularDamping);
    take(at, "focus", out.focus);
    take(at, "focusRadius", out.focusRadius);
    take(at, "focusYaw", out.focusYaw);
    take(at, "focusPitch", out.focusPitch);
    take(at, "focusFollows", out.focusFollows);
    if (at.has("puppets")) readPuppets(at["puppets"], out.puppets.emplace());
}

void readEntity(const JsonCursor& at, std::size_t index, const std::filesystem::path& folder, EntityScene& scene) {
    at.expectObject({"id", "name"},
                    {"parent", "transform", "meshRenderer", "rigidBody", "collider", "ragdoll", "light", "camera"});
    Entity entity;
    entity.id = UINT32_MAX - static_cast<EntityId>(index);  // one of its own, should there be none to read
    entity.name = "?";
    constexpr long long mostId = 1000000000;
    takeWhole(at, "id", entity.id, 1, mostId);
    take(at, "name", entity.name);
    takeWhole(at, "parent", entity.parent, 1, mostId);
    const EntityId id = entity.id;
    scene.entities.push_back(std::move(entity));
    if (at.has("transform")) scene.add(id, readTransform(at["transform"]));
    if (at.has("meshRenderer")) scene.add(id, readMeshRenderer(at["meshRenderer"]));
    if (at.has("rigidBody")) scene.add(id, readRigidBody(at["rigidBody"]));
    if (at.has("collider")) scene.add(id, readCollider(at["collider"]));
    if (at.has("ragdoll")) scene.add(id, readRagdoll(at["ragdoll"], folder));
    if (at.has("light")) scene.add(id, readLight(at["light"]));
    if (at.has("camera")) scene.add(id, readCamera(at["camera"]));
}

constexpr JsonDocumentKind kSceneDocument{"scene", "docs/scene.md describes every member"};

}  // namespace

Result<EntityScene> sceneFromJson(std::string_view text, std::string_view source, const std::filesystem::path& folder) {
    std::vector<std::string> problems;
    std::vector<std::string> duplicates;
    const Result<json> parsed = parseJson(text, source, duplicates);
    if (!parsed) return parsed.error();
    if (problems = checkFormat(parsed.value(), scene_format::kName, EntityScene::kVersion); !problems.empty())
        return refusedDocument(kSceneDocument, source, problems);
    problems = duplicates;
    const JsonCursor root(parsed.value(), problems);
    root.expectObject({"format", "version", "entities"}, {"$schema", "name", "simulation"});
    EntityScene scene;
    take(root, "name", scene.name);
    if (root.has("simulation")) readSimulation(root["simulation"], scene.simulation);
    const JsonCursor entities = root["entities"];
    if (root.has("entities") && entities.expectArray(0, kMostEntities)) {
        for (std::size_t i = 0; i < entities.size(); ++i)
            readEntity(entities[i], i, folder, scene);
    }
    const std::vector<std::string> unsound = validate(scene);
    problems.insert(problems.end(), unsound.begin(), unsound.end());
    if (!problems.empty()) return refusedDocument(kSceneDocument, source, problems);
    return scene;
}

Result<EntityScene> loadScene(const std::filesystem::path& file) {
    constexpr std::size_t mostBytes = std::size_t{64} << 20U;
    const Result<std::vector<unsigned char>> bytes = readFile(file, mostBytes);
    if (!bytes) return bytes.error();
    const auto* text = reinterpret_cast<const char*>(bytes.value().data());
    return sceneFromJson({text, bytes.value().size()}, file.string(), file.parent_path());
}

}  // namespace lutka::scene
