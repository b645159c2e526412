#include "report/doll_view.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base64.hpp"
#include "core/json/json_text.hpp"
#include "report/view_texture.hpp"

namespace lutka::reporting {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "arrays go into the page as they lie in memory");

constexpr int kTextureSide = 512;
constexpr float kSameM = 1e-4F;         // tracks nearer than this are one
constexpr float kSameRotation = 1e-4F;  // quaternion components

template <class T>
std::string packed(const std::vector<T>& values) {
    return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

void append(const RigidTransform& t, std::vector<float>& out) {
    const vec3& p = t.translation;
    const quat& q = t.rotation;
    out.insert(out.end(), {p.x, p.y, p.z, q.x, q.y, q.z, q.w});
}

bool alike(const RigidTransform& a, const RigidTransform& b) {
    const vec3 off = a.translation - b.translation;
    return glm::dot(off, off) <= kSameM * kSameM &&
           1.0F - std::abs(glm::dot(a.rotation, b.rotation)) <= 0.5F * kSameRotation * kSameRotation;
}

// How each joint moves its skin, as few of them as there are different motions.
class Tracks {
  public:
    Tracks(const animation::Character& character, std::span<const DropTrace> drops)
        : bind_(character.skeleton.bindModelFromJoint), drops_(drops), trackOf_(bind_.size(), -1) {
        for (const animation::SkinnedMesh& mesh : character.meshes) {
            for (std::size_t v = 0; v < mesh.joints.size(); ++v) {
                for (std::size_t i = 0; i < animation::kMaxInfluences; ++i) {
                    if (mesh.weights[v][i] > 0) need(mesh.joints[v][i]);
                }
            }
        }
    }

    [[nodiscard]] std::uint16_t of(std::uint16_t joint) const {
        return static_cast<std::uint16_t>(std::max(trackOf_[joint], 0));
    }

    // Of one drop, pose after pose.
    [[nodiscard]] std::vector<float> values(const DropTrace& drop) const {
        std::vector<float> out;
        for (int pose = 0; pose < drop.poses; ++pose) {
            for (const std::size_t joint : jointOfTrack_)
                append(worldFromBind(drop, pose, joint), out);
        }
        return out;
    }

  private:
    [[nodiscard]] RigidTransform worldFromBind(const DropTrace& drop, int pose, std::size_t joint) const {
        return drop.worldFromJoint[static_cast<std::size_t>(pose) * bind_.size() + joint] * inverse(bind_[joint]);
    }

    void need(std::uint16_t joint) {
        if (trackOf_[joint] >= 0) return;
        const auto known = std::find_if(jointOfTrack_.begin(), jointOfTrack_.end(),
                                        [&](std::size_t other) { return moveAlike(joint, other); });
        trackOf_[joint] = static_cast<int>(known - jointOfTrack_.begin());
        if (known == jointOfTrack_.end()) jointOfTrack_.push_back(joint);
    }

    [[nodiscard]] bool moveAlike(std::size_t a, std::size_t b) const {
        for (const DropTrace& drop : drops_) {
            for (int pose = drop.poses - 1; pose >= 0; --pose) {  // most differ at the end
                if (!alike(worldFromBind(drop, pose, a), worldFromBind(drop, pose, b))) return false;
            }
        }
        return true;
    }

    std::span<const RigidTransform> bind_;
    std::span<const DropTrace> drops_;
    std::vector<int> trackOf_;  // of each joint; -1: it moves no skin
    std::vector<std::size_t> jointOfTrack_;
};

// Eight bits each; what rounding leaves of 255 goes to the strongest, the first.
void appendWeights(const std::array<float, animation::kMaxInfluences>& weights, std::vector<std::uint8_t>& out) {
    std::array<int, animation::kMaxInfluences> bytes{};
    int sum = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<int>(std::lround(weights[i] * 255.0F));
        sum += bytes[i];
    }
    bytes[0] += 255 - sum;
    for (const int byte : bytes)
        out.push_back(static_cast<std::uint8_t>(std::clamp(byte, 0, 255)));
}

Json meshJson(const animation::SkinnedMesh& mesh, const animation::Character& character, const Tracks& tracks) {
    std::vector<std::int8_t> normals;
    for (const vec3& normal : mesh.normals) {
        for (const float c : {normal.x, normal.y, normal.z, 0.0F})
            normals.push_back(static_cast<std::int8_t>(std::lround(std::clamp(c, -1.0F, 1.0F) * 127.0F)));
    }
    std::vector<std::uint16_t> joints;
    std::vector<std::uint8_t> weights;
    for (std::size_t v = 0; v < mesh.joints.size(); ++v) {
        for (std::size_t i = 0; i < animation::kMaxInfluences; ++i)
            joints.push_back(mesh.weights[v][i] > 0 ? tracks.of(mesh.joints[v][i]) : std::uint16_t{0});
        appendWeights(mesh.weights[v], weights);
    }
    const auto material = static_cast<std::size_t>(mesh.material);
    const animation::Material look =
        material < character.materials.size() ? character.materials[material] : animation::Material{};
    using AlphaMode = animation::Material::AlphaMode;
    return {{"name", mesh.name},
            {"positions", packed(mesh.positions)},
            {"normals", packed(normals)},
            {"uvs", packed(mesh.uvs)},
            {"tracks", packed(joints)},
            {"weights", packed(weights)},
            {"indices", packed(mesh.indices)},
            {"color", {look.baseColor.x, look.baseColor.y, look.baseColor.z, look.baseColor.w}},
            {"texture", look.baseColorTexture},
            {"doubleSided", look.doubleSided},
            {"blend", look.alphaMode == AlphaMode::blend},
            {"cutoff", look.alphaMode == AlphaMode::mask ? look.alphaCutoff : 0.0F}};
}

// Only what some mesh shows; the others are left empty, so that indices stay.
Json texturesJson(const animation::Character& character) {
    std::vector<bool> used(character.textures.size());
    for (const animation::SkinnedMesh& mesh : character.meshes) {
        const auto material = static_cast<std::size_t>(mesh.material);
        if (material >= character.materials.size()) continue;
        const auto texture = static_cast<std::size_t>(character.materials[material].baseColorTexture);
        if (texture < used.size()) used[texture] = true;
    }
    Json textures = Json::array();
    for (std::size_t i = 0; i < used.size(); ++i)
        textures.push_back(used[i] ? textureUri(character.textures[i], kTextureSide) : "");
    return textures;
}

Json transformJson(const RigidTransform& t) {
    return {{"p", jsonVector(t.translation)}, {"q", jsonQuaternion(t.rotation)}};
}

// Triangles as corners, for the view knows no polygons.
Json hullJson(const physics::ConvexHull& hull) {
    Json points = Json::array();
    for (const physics::ConvexHull::Face& face : hull.faces()) {
        const std::span<const int> loop = hull.cornersOf(face);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            for (const int corner : {loop[0], loop[i], loop[i + 1]})
                for (int axis = 0; axis < 3; ++axis)
                    points.push_back(jsonNumber(hull.points()[corner][axis]));
    }
    return {{"kind", "hull"}, {"triangles", std::move(points)}};
}

Json shapeJson(const physics::PrimitiveShape& shape) {
    if (shape.kind == physics::PrimitiveShape::Kind::hull) return hullJson(*shape.hull);
    static constexpr std::array<const char*, 3> kKinds{"capsule", "box", "sphere"};
    const std::size_t kind = shape.kind == physics::PrimitiveShape::Kind::capsule ? 0
                             : shape.kind == physics::PrimitiveShape::Kind::box   ? 1
                                                                                  : 2;
    return {{"kind", kKinds[kind]},
            {"radius", jsonNumber(shape.radius)},
            {"halfLength", jsonNumber(shape.halfLength)},
            {"halfExtents", jsonVector(shape.halfExtents)}};
}

Json bodyJson(const physics::BodyProfile& body) {
    Json json = shapeJson(body.shape);
    json["name"] = body.name;
    json["more"] = Json::array();
    for (const physics::AddedShape& added : body.shape.more) {
        Json part = shapeJson(added);
        part["place"] = transformJson(added.bodyFromShape);
        json["more"].push_back(std::move(part));
    }
    return json;
}

Json constraintJson(const physics::ConstraintProfile& constraint) {
    Json json = {{"parent", constraint.parent},
                 {"child", constraint.child},
                 {"parentFromFrame", transformJson(constraint.parentFromFrame)},
                 {"childFromFrame", transformJson(constraint.childFromFrame)}};
    if (constraint.kind == physics::ConstraintProfile::Kind::hinge) {
        json["hinge"] = {jsonNumber(constraint.hinge.lower), jsonNumber(constraint.hinge.upper)};
    } else {
        json["cone"] = {jsonNumber(constraint.cone.swingY), jsonNumber(constraint.cone.swingZ),
                        jsonNumber(constraint.cone.twist)};
    }
    return json;
}

Json dropJson(const DropTrace& drop, const Tracks& tracks) {
    std::vector<float> bodies;
    for (const RigidTransform& body : drop.worldFromBody)
        append(body, bodies);
    return {{"poses", drop.poses}, {"bodies", packed(bodies)}, {"tracks", packed(tracks.values(drop))}};
}

// How far the skin reaches from the middle of the bodies in the bind pose, metres.
float reachOf(const scene::RagdollAsset& asset) {
    vec3 middle(0);
    for (const RigidTransform& body : asset.rig.bindModelFromBody)
        middle += body.translation / static_cast<float>(asset.rig.bindModelFromBody.size());
    float reach = 0.0F;
    for (const animation::SkinnedMesh& mesh : asset.character.meshes)
        for (const vec3& position : mesh.positions)
            reach = std::max(reach, glm::distance(middle, position));
    return reach;
}

}  // namespace

Json dollViewJson(const scene::RagdollAsset& asset, std::span<const DropTrace> drops) {
    const Tracks tracks(asset.character, drops);
    Json json;
    json["heightM"] = jsonNumber(asset.profile.heightM);
    json["reachM"] = jsonNumber(reachOf(asset));
    json["secondsAPose"] = drops.empty() ? 0.0F : drops.front().dt * static_cast<float>(DropTrace::kStepsAPose);
    json["textures"] = texturesJson(asset.character);
    for (const char* list : {"meshes", "bodies", "constraints", "drops"})
        json[list] = Json::array();
    for (const animation::SkinnedMesh& mesh : asset.character.meshes)
        json["meshes"].push_back(meshJson(mesh, asset.character, tracks));
    for (const physics::BodyProfile& body : asset.profile.bodies)
        json["bodies"].push_back(bodyJson(body));
    for (const physics::ConstraintProfile& constraint : asset.profile.constraints)
        json["constraints"].push_back(constraintJson(constraint));
    for (const DropTrace& drop : drops)
        json["drops"].push_back(dropJson(drop, tracks));
    return json;
}

}  // namespace lutka::reporting
