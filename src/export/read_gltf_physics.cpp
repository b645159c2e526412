#include "export/read_gltf_physics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "core/json/json_text.hpp"
#include "core/letter_case.hpp"
#include "export/gltf_names.hpp"
#include "export/gltf_scene.hpp"
#include "physics/collision/shape.hpp"
#include "physics/profile/constraint_frames.hpp"

namespace lutka::exporting {
namespace {

using animation::Role;
using nlohmann::json;
using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::PrimitiveShape;
using physics::RagdollProfile;

constexpr std::size_t kMostJsonBytes = std::size_t{32} << 20U;
constexpr std::size_t kMostBodies = RagdollProfile::kMostBodies;
constexpr std::size_t kLongestName = 200;
constexpr float kLocked = 1e-4F;       // radians: a limit that is none
constexpr float kLeastSpan = 1e-2F;    // of a cone; narrower ones jitter
constexpr float kMostSpan = 3.05433F;  // 175 degrees
constexpr float kSameTurn = 1e-3F;

/// The JSON of a .glb or .gltf file as text; empty when it has none of our concern.
std::string jsonOf(const std::filesystem::path& file) {
    const std::string ending = lowerCased(file.extension().string());
    if (ending != ".glb" && ending != ".gltf" && ending != ".vrm") return {};
    std::ifstream in(file, std::ios::binary);
    std::array<unsigned char, 20> head{};
    in.read(reinterpret_cast<char*>(head.data()), head.size());
    std::size_t length = kMostJsonBytes;
    if (in.gcount() == 20 && std::equal(head.begin(), head.begin() + 4, "glTF")) {
        length = head[12] | std::size_t{head[13]} << 8U | std::size_t{head[14]} << 16U | std::size_t{head[15]} << 24U;
    } else {
        in.clear();
        in.seekg(0);
    }
    std::string text(std::min(length, kMostJsonBytes), '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text.find(kPhysicsExtension) == std::string::npos ? std::string() : text;
}

// The constraint's limits in the making: the least range of each angle, and of the swing.
struct AngularRange {
    std::array<float, 3> low{-kPi, -kPi, -kPi};
    std::array<float, 3> high{kPi, kPi, kPi};
    float swing = kPi;

    [[nodiscard]] bool locked(int axis) const { return low[axis] > -kLocked && high[axis] < kLocked; }
};

class Reader {
  public:
    Reader(const json& document, const animation::Character& character, const animation::HumanoidMap& map)
        : document_(document), scene_(document), character_(character), map_(map) {}

    void readInto(RagdollProfile& profile) {
        findBodies();
        findJoints();
        arrange(profile);
        addFilteredPairs(profile);
    }
    [[nodiscard]] bool hasBodies() const {
        for (std::size_t i = 0; i < scene_.size(); ++i)
            if (motionOf(i) != nullptr) return true;
        return false;
    }

  private:
    struct Body {
        std::size_t node = 0;
        BodyProfile profile;
        RigidTransform sceneFromBody;
        const json* filter = nullptr;
        int parent = -1;
        ConstraintProfile constraint;
    };

    // The document's own extension object; null where there is none.
    [[nodiscard]] const json& resource(const char* name) const {
        static const json kNothing;
        const json* extensions = memberOf(document_, "extensions");
        const json* found = extensions == nullptr ? nullptr : memberOf(*extensions, name);
        return found == nullptr ? kNothing : *found;
    }
    [[nodiscard]] const json* partOf(std::size_t node, const char* part) const {
        const json* extension = scene_.extension(node, kPhysicsExtension);
        return extension == nullptr ? nullptr : memberOf(*extension, part);
    }
    [[nodiscard]] const json* motionOf(std::size_t node) const { return partOf(node, "motion"); }
    // The nearest node with a motion, from this one up; -1 when there is none.
    [[nodiscard]] int motionAbove(std::size_t node) const {
        for (int at = static_cast<int>(node); at >= 0; at = scene_[at].parent)
            if (motionOf(at) != nullptr) return at;
        return -1;
    }

    // Importing may put a root of its own above the file's.
    [[nodiscard]] int jointOf(std::size_t node) const {
        const int named = animation::findJoint(character_.skeleton, scene_[node].name);
        if (named != animation::kNoJoint) return named;
        const std::string own = scene_.pathOf(node);
        for (const std::string& path : {own, "ROOT/" + own}) {
            const int joint = animation::findJoint(character_.skeleton, path);
            if (joint != animation::kNoJoint) return joint;
        }
        throw Unusable{fmt::format("the body '{}' is no joint of the figure", scene_[node].name)};
    }

    [[nodiscard]] std::optional<Role> roleOf(const json& motion, int joint) const {
        const json* extras = memberOf(motion, "extras");
        const json* named = extras == nullptr ? nullptr : memberOf(*extras, kRoleKey);
        if (named != nullptr && named->is_string()) {
            if (const auto role = animation::roleFromName(named->get<std::string>())) return *role;
        }
        for (int i = 0; i < animation::kRoleCount; ++i)
            if (map_.jointOf(animation::roleAt(i)) == joint) return animation::roleAt(i);
        return std::nullopt;
    }

    [[nodiscard]] std::string nameOf(const json& motion, std::size_t node) const {
        const json* extras = memberOf(motion, "extras");
        const json* named = extras == nullptr ? nullptr : memberOf(*extras, kNameKey);
        return named != nullptr && named->is_string() ? named->get<std::string>() : scene_[node].name;
    }

    // The name, with a number where another body has it.
    [[nodiscard]] std::string freeName(const std::string& name) const {
        const auto taken = [&](const std::string& word) {
            return animation::roleFromName(word) ||
                   std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& b) { return b.profile.name == word; });
        };
        std::string word = name.empty() ? "body" : name.substr(0, kLongestName);
        for (int number = 2; taken(word); ++number)
            word = fmt::format("{}_{}", name.empty() ? "body" : name.substr(0, kLongestName), number);
        return word;
    }

    // The corners that we write beside a hull's mesh; of others' meshes, whose bytes are not looked at, nothing.
    [[nodiscard]] static std::vector<vec3> cornersOf(const json& geometry) {
        const json* extras = memberOf(geometry, "extras");
        const json* corners = extras == nullptr ? nullptr : memberOf(*extras, kCornersKey);
        std::vector<vec3> points;
        if (corners == nullptr || !corners->is_array() || corners->size() > physics::ConvexHull::kMostPoints) return {};
        for (const json& corner : *corners) {
            if (!corner.is_array() || corner.size() != 3) return {};
            vec3 point(0);
            for (int axis = 0; axis < 3; ++axis) {
                const json& number = corner[static_cast<std::size_t>(axis)];
                if (!number.is_number() || !std::isfinite(number.get<float>())) return {};
                point[axis] = number.get<float>();
            }
            points.push_back(point);
        }
        return points;
    }

    [[nodiscard]] PrimitiveShape shapeOf(const json& collider, float scale) const {
        const json* geometry = memberOf(collider, "geometry");
        if (std::vector<vec3> corners = geometry == nullptr ? std::vector<vec3>() : cornersOf(*geometry);
            !corners.empty()) {
            for (vec3& corner : corners)
                corner *= scale;
            PrimitiveShape out;
            out.kind = PrimitiveShape::Kind::hull;
            out.hull = physics::makeConvexHull(corners);
            if (out.hull == nullptr) throw Unusable{"a collider's hull is flat"};
            return out;
        }
        const json* shape =
            geometry == nullptr ? nullptr : itemOf(resource(kShapesExtension), "shapes", indexIn(*geometry, "shape"));
        if (shape == nullptr) throw Unusable{"a collider is no capsule, sphere or box, and no hull that we wrote"};
        PrimitiveShape out;
        if (const json* capsule = memberOf(*shape, "capsule")) {
            const float bottom = numberIn(*capsule, "radiusBottom").value_or(0.25F);
            const float top = numberIn(*capsule, "radiusTop").value_or(0.25F);
            out.kind = PrimitiveShape::Kind::capsule;
            out.radius = 0.5F * (bottom + top) * scale;
            out.halfLength = 0.5F * numberIn(*capsule, "height").value_or(0.5F) * scale;
        } else if (const json* sphere = memberOf(*shape, "sphere")) {
            out.kind = PrimitiveShape::Kind::sphere;
            out.radius = numberIn(*sphere, "radius").value_or(0.5F) * scale;
        } else if (const json* box = memberOf(*shape, "box")) {
            const auto size = numbersIn(*box, "size", 3);
            out.kind = PrimitiveShape::Kind::box;
            out.halfExtents = (size.empty() ? vec3(1) : vec3(size[0], size[1], size[2])) * (0.5F * scale);
        } else {
            throw Unusable{"a collider is no capsule, sphere or box, and no hull that we wrote"};
        }
        return out;
    }

    // Principal moments about the shape's axes, of a tensor told about others: what lies off the diagonal is lost.
    static vec3 momentsAbout(const quat& bodyFromInertia, const vec3& moments) {
        const mat3 turn = glm::mat3_cast(bodyFromInertia);
        vec3 out(0);
        for (int row = 0; row < 3; ++row)
            for (int k = 0; k < 3; ++k)
                out[row] += turn[k][row] * turn[k][row] * moments[k];
        return out;
    }

    void addBody(std::size_t node, std::size_t colliderNode) {
        const json& motion = *motionOf(node);
        const json& collider = *partOf(colliderNode, "collider");
        Body body;
        body.node = node;
        body.filter = &collider;
        const int joint = jointOf(node);
        BodyProfile& profile = body.profile;
        profile.role = roleOf(motion, joint);
        profile.name = profile.role ? std::string(roleName(*profile.role)) : freeName(nameOf(motion, node));
        profile.joint = character_.skeleton.names[joint];
        profile.jointPath = animation::jointPath(character_.skeleton, joint);
        profile.shape = {shapeOf(collider, scene_[colliderNode].scale), {}};
        body.sceneFromBody = scene_[colliderNode].sceneFromNode;
        profile.jointFromBody = inverse(scene_[node].sceneFromNode) * body.sceneFromBody;
        profile.jointFromBody.rotation = glm::normalize(profile.jointFromBody.rotation);
        profile.massKg = numberIn(motion, "mass").value_or(0.0F);
        if (profile.massKg <= 0.0F) profile.massKg = 1000.0F * physics::shapeVolume(profile.shape);
        profile.inertia = physics::shapeInertia(profile.shape, profile.massKg);
        if (const auto moments = numbersIn(motion, "inertiaDiagonal", 3); !moments.empty()) {
            profile.inertia = vec3(moments[0], moments[1], moments[2]);
            const auto q = numbersIn(motion, "inertiaOrientation", 4);
            const quat nodeFromInertia = q.empty() ? quat(1, 0, 0, 0) : quat(q[3], q[0], q[1], q[2]);
            const quat turn = glm::conjugate(profile.jointFromBody.rotation) * nodeFromInertia;
            if (std::abs(std::abs(turn.w) - 1.0F) > kSameTurn * kSameTurn)
                profile.inertia = momentsAbout(turn, profile.inertia);
        }
        bodyOfNode_[static_cast<int>(node)] = static_cast<int>(bodies_.size());
        bodies_.push_back(std::move(body));
    }

    // Whether a collider is of a kind that a body can have.
    [[nodiscard]] bool isSimple(std::size_t colliderNode) const {
        const json* geometry = memberOf(*partOf(colliderNode, "collider"), "geometry");
        if (geometry != nullptr && !cornersOf(*geometry).empty()) return true;
        const json* shape =
            geometry == nullptr ? nullptr : itemOf(resource(kShapesExtension), "shapes", indexIn(*geometry, "shape"));
        return shape != nullptr && (memberOf(*shape, "capsule") != nullptr || memberOf(*shape, "sphere") != nullptr ||
                                    memberOf(*shape, "box") != nullptr);
    }

    void addShape(Body& body, std::size_t colliderNode) {
        physics::BodyShape& shape = body.profile.shape;
        const bool weighed = numberIn(*motionOf(body.node), "mass").value_or(0.0F) > 0.0F;
        const bool turned = !numbersIn(*motionOf(body.node), "inertiaDiagonal", 3).empty();
        shape.more.push_back({shapeOf(*partOf(colliderNode, "collider"), scene_[colliderNode].scale),
                              inverse(body.sceneFromBody) * scene_[colliderNode].sceneFromNode});
        quat& rotation = shape.more.back().bodyFromShape.rotation;
        rotation = glm::normalize(rotation);
        if (!weighed) body.profile.massKg = 1000.0F * physics::shapeVolume(shape);
        if (!turned) body.profile.inertia = physics::shapeInertia(shape, body.profile.massKg);
    }

    // A body's main shape is its motion's first collider; the next ones are its further shapes, as far as it can have
    // them; what is beyond that is left out.
    void findBodies() {
        for (std::size_t i = 0; i < scene_.size(); ++i) {
            if (partOf(i, "collider") == nullptr) continue;
            const int motion = motionAbove(i);
            if (motion < 0) continue;
            if (const auto known = bodyOfNode_.find(motion); known != bodyOfNode_.end()) {
                Body& body = bodies_[static_cast<std::size_t>(known->second)];
                if (body.profile.shape.more.size() < physics::BodyShape::kMostAdded && isSimple(i)) addShape(body, i);
                continue;
            }
            if (bodies_.size() >= kMostBodies)
                throw Unusable{fmt::format("there are more than {} bodies", kMostBodies)};
            addBody(static_cast<std::size_t>(motion), i);
        }
        if (bodies_.empty()) throw Unusable{"no body has a collider"};
    }

    [[nodiscard]] AngularRange rangeOf(const json& joint) const {
        AngularRange range;
        const json* limits = memberOf(joint, "limits");
        if (limits == nullptr || !limits->is_array()) return range;
        for (const json& limit : *limits) {
            const json* axes = memberOf(limit, "angularAxes");
            if (axes == nullptr || !axes->is_array()) continue;
            const float low = numberIn(limit, "min").value_or(-kPi);
            const float high = numberIn(limit, "max").value_or(kPi);
            std::vector<int> which;
            for (const json& axis : *axes)
                if (axis.is_number_unsigned() && axis.get<std::uint64_t>() < 3) which.push_back(axis.get<int>());
            const bool swing = which.size() == 2 && std::find(which.begin(), which.end(), 0) == which.end();
            if (swing && high > kLocked) range.swing = std::min(range.swing, high);
            if (which.size() > 1 && high > kLocked) continue;
            for (const int axis : which) {
                range.low[axis] = std::max(range.low[axis], std::max(low, -kPi));
                range.high[axis] = std::min(range.high[axis], std::min(high, kPi));
            }
        }
        return range;
    }

    // Ranges that are not even about zero move the neutral pose to their middle.
    static void setLimits(const AngularRange& range, ConstraintProfile& constraint) {
        if (range.locked(0) && range.locked(1)) {
            constraint.kind = ConstraintProfile::Kind::hinge;
            constraint.hinge = {std::min(range.low[2], 0.0F), std::max(range.high[2], 0.0F)};
            return;
        }
        constraint.kind = ConstraintProfile::Kind::coneTwist;
        std::array<float, 3> half{};
        for (int axis = 0; axis < 3; ++axis) {
            const float middle = 0.5F * (range.low[axis] + range.high[axis]);
            half[axis] = 0.5F * (range.high[axis] - range.low[axis]);
            if (axis > 0) half[axis] = std::min(half[axis], range.swing);
            half[axis] = std::clamp(half[axis], kLeastSpan, kMostSpan);
            vec3 about(0);
            about[axis] = 1.0F;
            if (std::abs(middle) > kLocked) physics::shiftNeutral(constraint, glm::angleAxis(middle, about));
        }
        constraint.cone = {half[1], half[2], half[0]};
    }

    static float frictionOf(const json& joint) {
        const json* drives = memberOf(joint, "drives");
        float friction = 0.0F;
        if (drives == nullptr || !drives->is_array()) return friction;
        for (const json& drive : *drives) {
            const bool holds = numberIn(drive, "velocityTarget").value_or(1.0F) == 0.0F;
            if (holds) friction = std::max(friction, numberIn(drive, "maxForce").value_or(0.0F));
        }
        return friction;
    }

    // The frame of the joint node is the parent's, that of the node it is connected to the child's.
    void findJoints() {
        for (std::size_t i = 0; i < scene_.size(); ++i) {
            const json* link = partOf(i, "joint");
            if (link == nullptr) continue;
            const auto other = indexIn(*link, "connectedNode");
            const json* joint = itemOf(resource(kPhysicsExtension), "physicsJoints", indexIn(*link, "joint"));
            if (!other || static_cast<std::size_t>(*other) >= scene_.size() || joint == nullptr) continue;
            const auto a = bodyOfNode_.find(motionAbove(i));
            const auto b = bodyOfNode_.find(motionAbove(static_cast<std::size_t>(*other)));
            if (a == bodyOfNode_.end() || b == bodyOfNode_.end() || a->second == b->second) continue;
            Body& child = bodies_[b->second];
            if (child.parent >= 0) throw Unusable{fmt::format("'{}' hangs on two bodies", child.profile.joint)};
            child.parent = a->second;
            ConstraintProfile& c = child.constraint;
            c.parentFromFrame = inverse(bodies_[a->second].sceneFromBody) * scene_[i].sceneFromNode;
            c.childFromFrame = inverse(child.sceneFromBody) * scene_[*other].sceneFromNode;
            c.frictionNm = frictionOf(*joint);
            setLimits(rangeOf(*joint), c);
        }
    }

    [[nodiscard]] static bool comesBefore(const BodyProfile& a, const BodyProfile& b) {
        return a.role && (!b.role || *a.role < *b.role);
    }

    // Parents first, else by role, those without one last.
    void arrange(RagdollProfile& profile) {
        std::vector<int> place(bodies_.size(), -1);
        profile.bodies.clear();
        profile.constraints.clear();
        while (order_.size() < bodies_.size()) {
            int next = -1;
            for (std::size_t i = 0; i < bodies_.size(); ++i) {
                const bool hangs = bodies_[i].parent < 0 ? order_.empty() : place[bodies_[i].parent] >= 0;
                if (place[i] >= 0 || !hangs) continue;
                if (next < 0 || comesBefore(bodies_[i].profile, bodies_[next].profile)) next = static_cast<int>(i);
            }
            if (next < 0) throw Unusable{"the bodies do not hang on one root as one tree"};
            place[next] = static_cast<int>(order_.size());
            Body& body = bodies_[next];
            if (body.parent >= 0) {
                body.constraint.parent = place[body.parent];
                body.constraint.child = place[next];
                profile.constraints.push_back(body.constraint);
            }
            profile.bodies.push_back(body.profile);
            order_.push_back(next);
        }
        profile.totalMassKg = 0.0F;
        for (const BodyProfile& body : profile.bodies)
            profile.totalMassKg += body.massKg;
    }

    // Texts of a filter's list, of the body's collider.
    [[nodiscard]] std::vector<std::string> systems(const Body& body, const char* list) const {
        const json* filter =
            itemOf(resource(kPhysicsExtension), "collisionFilters", indexIn(*body.filter, "collisionFilter"));
        const json* names = filter == nullptr ? nullptr : memberOf(*filter, list);
        std::vector<std::string> out;
        if (names == nullptr || !names->is_array()) return out;
        for (const json& name : *names)
            if (name.is_string()) out.push_back(name.get<std::string>());
        return out;
    }
    [[nodiscard]] bool refuses(const Body& body, const Body& other) const {
        const auto refused = systems(body, "notCollideWithSystems");
        const auto taken = systems(body, "collideWithSystems");
        bool known = taken.empty();
        for (const std::string& system : systems(other, "collisionSystems")) {
            if (std::find(refused.begin(), refused.end(), system) != refused.end()) return true;
            known = known || std::find(taken.begin(), taken.end(), system) != taken.end();
        }
        return !known;
    }
    void addFilteredPairs(RagdollProfile& profile) const {
        profile.filteredPairs.clear();
        for (int a = 0; a < static_cast<int>(order_.size()); ++a) {
            for (int b = a + 1; b < static_cast<int>(order_.size()); ++b) {
                const Body& first = bodies_[order_[a]];
                const Body& second = bodies_[order_[b]];
                const bool linked = first.parent == order_[b] || second.parent == order_[a];
                if (!linked && (refuses(first, second) || refuses(second, first)))
                    profile.filteredPairs.emplace_back(a, b);
            }
        }
    }

    const json& document_;
    GltfScene scene_;
    const animation::Character& character_;
    const animation::HumanoidMap& map_;
    std::vector<Body> bodies_;
    std::map<int, int> bodyOfNode_;
    std::vector<int> order_;  // the profile's body → ours
};

}  // namespace

Result<std::optional<RagdollProfile>> readGltfPhysics(const std::filesystem::path& file,
                                                      const animation::Character& character,
                                                      const animation::HumanoidMap& map, const RagdollProfile& base) {
    const std::string text = jsonOf(file);
    if (text.empty()) return std::optional<RagdollProfile>();
    std::vector<std::string> duplicateKeys;
    const auto document = parseJson(text, file.string(), duplicateKeys);
    if (!document) return document.error();
    try {
        Reader reader(document.value(), character, map);
        if (!reader.hasBodies()) return std::optional<RagdollProfile>();
        RagdollProfile profile = base;
        profile.notes.clear();
        reader.readInto(profile);
        const std::vector<std::string> problems = physics::validate(profile);
        if (!problems.empty()) throw Unusable{problems.front()};
        return std::optional<RagdollProfile>(std::move(profile));
    } catch (const Unusable& unusable) {
        return Error{ErrorCode::input, unusable.why, file.string(), ""};
    }
}

}  // namespace lutka::exporting
