#include "export/write_gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>

#include "animation/export/write_glb.hpp"
#include "core/json/json_text.hpp"
#include "export/doll_layout.hpp"
#include "export/glb_container.hpp"
#include "export/gltf_names.hpp"

namespace lutka::exporting {
namespace {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::PrimitiveShape;
using physics::RagdollProfile;
using Json = nlohmann::ordered_json;

// A drive reaches the torque of our dry friction at this speed.
constexpr float kSlipSpeed = 0.1F;  // rad/s

// Rounding leaves components like 1.0000001, which glTF forbids.
Json rotationJson(const quat& rotation) {
    const quat unit = glm::normalize(rotation);
    return jsonQuaternion({std::clamp(unit.w, -1.0F, 1.0F), std::clamp(unit.x, -1.0F, 1.0F),
                           std::clamp(unit.y, -1.0F, 1.0F), std::clamp(unit.z, -1.0F, 1.0F)});
}
Json lockedLinear() {
    return Json{{"linearAxes", {0, 1, 2}}, {"min", 0}, {"max", 0}};
}
Json angular(const std::vector<int>& axes, float low, float high) {
    return Json{{"angularAxes", axes}, {"min", jsonNumber(low)}, {"max", jsonNumber(high)}};
}

Json shapeJson(const PrimitiveShape& shape) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::capsule:
            if (shape.halfLength <= 0.0F) break;  // a height of 0 is refused there: a sphere
            return Json{{"type", "capsule"},
                        {"capsule",
                         {{"height", jsonNumber(2.0F * shape.halfLength)},
                          {"radiusBottom", jsonNumber(shape.radius)},
                          {"radiusTop", jsonNumber(shape.radius)}}}};
        case PrimitiveShape::Kind::box:
            return Json{{"type", "box"}, {"box", {{"size", jsonVector(2.0F * shape.halfExtents)}}}};
        case PrimitiveShape::Kind::hull:  // a mesh, see hullNode()
        case PrimitiveShape::Kind::sphere:
            break;
    }
    return Json{{"type", "sphere"}, {"sphere", {{"radius", jsonNumber(shape.radius)}}}};
}

Json extrasOf(const physics::BodyProfile& body) {
    Json extras{{kNameKey, body.name}};
    if (body.role) extras[kRoleKey] = roleName(*body.role);
    return extras;
}

class GltfPhysicsWriter {
  public:
    GltfPhysicsWriter(const ExportSource& source, GlbContainer& container)
        : source_(source), profile_(source.profile), document_(container.json), binary_(container.binary) {}

    std::vector<std::string> write() {
        physics_["physicsMaterials"] = Json::array({Json{{"staticFriction", jsonNumber(physics::kBodyFriction)},
                                                         {"dynamicFriction", jsonNumber(physics::kBodyFriction)},
                                                         {"frictionCombine", "multiply"},
                                                         {"restitution", 0}}});
        for (std::size_t i = 0; i < profile_.bodies.size(); ++i)
            addBody(static_cast<int>(i));
        for (const ConstraintProfile& constraint : profile_.constraints)
            addJoint(constraint);
        if (!binary_.empty()) document_["buffers"][0]["byteLength"] = binary_.size();
        if (!shapes_.empty()) document_["extensions"][kShapesExtension] = Json{{"shapes", std::move(shapes_)}};
        document_["extensions"][kPhysicsExtension] = std::move(physics_);
        if (document_["extensions"].contains(kShapesExtension)) document_["extensionsUsed"].push_back(kShapesExtension);
        document_["extensionsUsed"].push_back(kPhysicsExtension);
        return std::move(warnings_);
    }

  private:
    [[nodiscard]] int nodeOf(int body) const { return 1 + source_.rig.jointOfBody[body]; }

    // A node below the body's joint; `bodyFromNode` places it.
    int addNode(int body, const std::string& suffix, const RigidTransform& bodyFromNode, Json extension) {
        const RigidTransform jointFromNode = profile_.bodies[body].jointFromBody * bodyFromNode;
        Json node{{"name", bodyName(profile_, body) + " " + suffix},
                  {"rotation", rotationJson(jointFromNode.rotation)},
                  {"translation", jsonVector(jointFromNode.translation)}};
        if (!extension.is_null()) node["extensions"] = Json{{kPhysicsExtension, std::move(extension)}};
        const int index = static_cast<int>(document_["nodes"].size());
        document_["nodes"].push_back(std::move(node));
        document_["nodes"][nodeOf(body)]["children"].push_back(index);
        return index;
    }

    void addBody(int index) {
        const BodyProfile& body = profile_.bodies[index];
        Json& node = document_["nodes"][nodeOf(index)];
        node["extensions"][kPhysicsExtension] =
            Json{{"motion",
                  {{"mass", jsonNumber(body.massKg)},
                   {"centerOfMass", jsonVector(body.jointFromBody.translation)},
                   {"inertiaDiagonal", jsonVector(body.inertia)},
                   {"inertiaOrientation", rotationJson(body.jointFromBody.rotation)},
                   {"extras", extrasOf(profile_.bodies[index])}}}};
        const int filter = addFilter(index);
        int count = 0;
        visitShapes(body.shape, [&](const PrimitiveShape& shape, const RigidTransform& bodyFromShape) {
            Json geometry;
            if (shape.kind == PrimitiveShape::Kind::hull) {
                Json corners = Json::array();
                for (const vec3& point : shape.hull->points())
                    corners.push_back(jsonVector(point));
                geometry = Json{{"convexHull", true},
                                {"node", addHullNode(index, *shape.hull)},
                                {"extras", {{kCornersKey, std::move(corners)}}}};
            } else {
                geometry = Json{{"shape", shapes_.size()}};
                shapes_.push_back(shapeJson(shape));
            }
            Json collider{{"geometry", std::move(geometry)}, {"physicsMaterial", 0}};
            if (filter >= 0) collider["collisionFilter"] = filter;
            ++count;
            addNode(index, count == 1 ? "collider" : fmt::format("collider {}", count), bodyFromShape,
                    Json{{"collider", std::move(collider)}});
        });
    }

    // Index of an accessor over data at the buffer's end.
    template <class T>
    int addAccessor(const std::vector<T>& values, int componentType, std::size_t count, Json accessor) {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        const std::size_t bytes = values.size() * sizeof(T);
        Json& views = document_["bufferViews"];
        views.push_back(Json{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}});
        binary_.append(reinterpret_cast<const char*>(values.data()), bytes);
        accessor["bufferView"] = views.size() - 1;
        accessor["componentType"] = componentType;
        accessor["count"] = count;
        document_["accessors"].push_back(std::move(accessor));
        return static_cast<int>(document_["accessors"].size()) - 1;
    }

    // A mesh on a node that is in no scene, so that nothing draws it. A collider lies where its own node is.
    int addHullNode(int body, const physics::ConvexHull& hull) {
        constexpr int kFloat = 5126;
        constexpr int kUnsignedShort = 5123;
        std::vector<std::uint16_t> triangles;
        for (const physics::ConvexHull::Face& face : hull.faces()) {
            const std::span<const int> loop = hull.cornersOf(face);
            for (std::size_t i = 1; i + 1 < loop.size(); ++i)
                for (const int corner : {loop[0], loop[i], loop[i + 1]})
                    triangles.push_back(static_cast<std::uint16_t>(corner));
        }
        const std::vector<vec3> points(hull.points().begin(), hull.points().end());
        const int positions =
            addAccessor(points, kFloat, points.size(),
                        Json{{"type", "VEC3"}, {"min", jsonVector(hull.low())}, {"max", jsonVector(hull.high())}});
        const int indices = addAccessor(triangles, kUnsignedShort, triangles.size(), Json{{"type", "SCALAR"}});
        const std::string name = bodyName(profile_, body) + " hull";
        document_["meshes"].push_back(
            Json{{"name", name},
                 {"primitives", Json::array({Json{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}})}});
        document_["nodes"].push_back(Json{{"name", name}, {"mesh", document_["meshes"].size() - 1}});
        return static_cast<int>(document_["nodes"].size()) - 1;
    }

    // Index of the filter; -1 for a body that collides with all but those that it is linked to.
    int addFilter(int body) {
        Json others = Json::array();
        for (const auto& [first, second] : profile_.filteredPairs) {
            if (first == body) others.push_back(bodyName(profile_, second));
            if (second == body) others.push_back(bodyName(profile_, first));
        }
        if (others.empty()) return -1;
        Json& filters = physics_["collisionFilters"];
        filters.push_back(Json{{"collisionSystems", Json::array({bodyName(profile_, body)})},
                               {"notCollideWithSystems", std::move(others)}});
        return static_cast<int>(filters.size()) - 1;
    }

    Json limitsOf(const ConstraintProfile& c) {
        Json limits = Json::array({lockedLinear()});
        if (c.kind == ConstraintProfile::Kind::hinge) {
            limits.push_back(angular({0}, 0, 0));
            limits.push_back(angular({1}, 0, 0));
            limits.push_back(angular({2}, c.hinge.lower, c.hinge.upper));
            return limits;
        }
        limits.push_back(angular({0}, -c.cone.twist, c.cone.twist));
        if (c.cone.swingY == c.cone.swingZ) {
            limits.push_back(angular({1, 2}, 0, c.cone.swingY));
            return limits;
        }
        limits.push_back(angular({1}, -c.cone.swingY, c.cone.swingY));
        limits.push_back(angular({2}, -c.cone.swingZ, c.cone.swingZ));
        limits.push_back(angular({1, 2}, 0, std::max(c.cone.swingY, c.cone.swingZ)));
        warnings_.push_back(fmt::format(
            "{}: the elliptic cone of {:.0f} by {:.0f} degrees is a rectangle within a round cone of {:.0f}",
            bodyName(profile_, c.child), degrees(c.cone.swingY), degrees(c.cone.swingZ),
            degrees(std::max(c.cone.swingY, c.cone.swingZ))));
        return limits;
    }

    static Json drivesOf(const ConstraintProfile& c) {
        Json drives = Json::array();
        for (int axis = c.kind == ConstraintProfile::Kind::hinge ? 2 : 0; axis < 3; ++axis) {
            drives.push_back(Json{{"type", "angular"},
                                  {"mode", "force"},
                                  {"axis", axis},
                                  {"maxForce", jsonNumber(c.frictionNm)},
                                  {"velocityTarget", 0},
                                  {"damping", jsonNumber(c.frictionNm / kSlipSpeed)}});
        }
        return drives;
    }

    void addJoint(const ConstraintProfile& c) {
        Json joint{{"name", bodyName(profile_, c.child)}, {"limits", limitsOf(c)}};
        if (c.frictionNm > 0.0F) joint["drives"] = drivesOf(c);
        Json& joints = physics_["physicsJoints"];
        joints.push_back(std::move(joint));
        const int onChild = addNode(c.child, "joint", c.childFromFrame, {});
        addNode(c.parent, "to " + bodyName(profile_, c.child) + " joint", c.parentFromFrame,
                Json{{"joint", {{"connectedNode", onChild}, {"joint", joints.size() - 1}}}});
    }

    const ExportSource& source_;
    const RagdollProfile& profile_;
    Json& document_;
    std::string& binary_;
    Json physics_ = Json::object();
    Json shapes_ = Json::array();
    std::vector<std::string> warnings_;
};

}  // namespace

Result<Exported> writeGltf(const ExportSource& source, GltfKind kind) {
    const auto bytes = animation::glbBytes("glTF", source.character, {}, standingFromModel(source));
    if (!bytes) return bytes.error();
    GlbContainer container = unpackGlb(bytes.value());
    Exported exported;
    exported.warnings = GltfPhysicsWriter(source, container).write();
    exported.warnings.insert(exported.warnings.begin(),
                             "KHR_physics_rigid_bodies is a draft: few programs read it, and it may change");
    exported.bytes = kind == GltfKind::binary ? packGlb(container) : gltfText(container);
    return exported;
}

}  // namespace lutka::exporting
