#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "physics/profile/profile_format.hpp"
#include "physics/profile/profile_io.hpp"

namespace lutka::physics {
namespace {

using nlohmann::json;

constexpr float kLargest = 1e6F;  // of any length, mass or moment; beyond it floats in a simulation mean nothing
constexpr float kSmallest = 1e-9F;

quat readQuaternion(const JsonCursor& at) {
    const std::vector<float> v = at.numbers(4, -1.01F, 1.01F);
    const quat q(v[3], v[0], v[1], v[2]);
    if (at.readable() && std::abs(glm::dot(q, q) - 1.0F) > 1e-4F)
        at.report("expected a quaternion [x, y, z, w] of length 1");
    return q;
}

vec3 readVector(const JsonCursor& at, float low, float high) {
    const std::vector<float> v = at.numbers(3, low, high);
    return {v[0], v[1], v[2]};
}

RigidTransform readFrame(const JsonCursor& at) {
    at.expectObject({"rotation", "translation"});
    return {readQuaternion(at["rotation"]), readVector(at["translation"], -kLargest, kLargest)};
}

// Where a shape stands: version 1 knew no others beside the main one, and no hulls.
enum class ShapePlace { main, alone, added };

void expectMembers(const JsonCursor& at, PrimitiveShape::Kind kind, ShapePlace place) {
    const auto expect = [&](std::initializer_list<const char*> own, std::initializer_list<const char*> added) {
        if (place == ShapePlace::added)
            at.expectObject(added);
        else if (place == ShapePlace::alone)
            at.expectObject(own);
        else
            at.expectObject(own, {"more"});
    };
    switch (kind) {
        case PrimitiveShape::Kind::capsule:
            expect({"kind", "radius", "halfLength"}, {"kind", "radius", "halfLength", "bodyFromShape"});
            break;
        case PrimitiveShape::Kind::box:
            expect({"kind", "halfExtents"}, {"kind", "halfExtents", "bodyFromShape"});
            break;
        case PrimitiveShape::Kind::sphere:
            expect({"kind", "radius"}, {"kind", "radius", "bodyFromShape"});
            break;
        case PrimitiveShape::Kind::hull:
            expect({"kind", "points"}, {"kind", "points", "bodyFromShape"});
            break;
    }
}

// Null, and reported, where the points are no corners of a hull.
ConvexHullPtr readHull(const JsonCursor& at) {
    if (!at.expectArray(ConvexHull::kFewestPoints, ConvexHull::kMostPoints)) return nullptr;
    std::vector<vec3> points;
    bool readable = true;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const JsonCursor point = at[i];
        points.push_back(readVector(point, -kLargest, kLargest));
        readable = readable && point.readable();
    }
    if (!readable) return nullptr;
    ConvexHullPtr hull = makeConvexHull(points);
    if (hull == nullptr) {
        at.report("expected points whose hull is not flat");
        return nullptr;
    }
    const std::span<const vec3> corners = hull->points();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i < corners.size() && corners[i] == points[i]) continue;
        at[i].report(
            "expected a corner of the points' convex hull, this one lies inside, on its surface or on another");
        return nullptr;
    }
    if (!isCentred(*hull)) {
        const vec3& middle = hull->centroid();
        at.report(
            fmt::format("expected points about the middle of their hull's volume, it is at [{:.3g}, {:.3g}, {:.3g}]",
                        middle.x, middle.y, middle.z));
    }
    return hull;
}

PrimitiveShape readPrimitive(const JsonCursor& at, ShapePlace place) {
    constexpr std::array kKinds{PrimitiveShape::Kind::capsule, PrimitiveShape::Kind::box, PrimitiveShape::Kind::sphere,
                                PrimitiveShape::Kind::hull};
    PrimitiveShape shape;
    const std::array kNames{"capsule", "box", "sphere", "hull"};
    const std::size_t known = place == ShapePlace::alone ? 3 : kNames.size();
    const int kind = at["kind"].oneOf(std::span<const char* const>(kNames).first(known));
    if (kind < 0) return shape;
    shape.kind = kKinds[static_cast<std::size_t>(kind)];
    expectMembers(at, shape.kind, place);
    if (shape.kind == PrimitiveShape::Kind::hull) {
        shape.hull = readHull(at["points"]);
        return shape;
    }
    if (shape.kind == PrimitiveShape::Kind::box) {
        shape.halfExtents = readVector(at["halfExtents"], kSmallest, kLargest);
        return shape;
    }
    shape.radius = at["radius"].number(kSmallest, kLargest);
    if (shape.kind == PrimitiveShape::Kind::capsule) shape.halfLength = at["halfLength"].number(0.0F, kLargest);
    return shape;
}

BodyShape readShape(const JsonCursor& at, std::int64_t version) {
    BodyShape shape{readPrimitive(at, version == 1 ? ShapePlace::alone : ShapePlace::main), {}};
    if (version == 1 || !at.has("more")) return shape;
    const JsonCursor more = at["more"];
    if (!more.expectArray(1, static_cast<int>(BodyShape::kMostAdded))) return shape;
    for (std::size_t i = 0; i < more.size(); ++i)
        shape.more.push_back({readPrimitive(more[i], ShapePlace::added), readFrame(more[i]["bodyFromShape"])});
    return shape;
}

std::optional<Role> readRole(const JsonCursor& at) {
    const std::string name = at.text();
    const std::optional<Role> role = animation::roleFromName(name);
    if (at.readable() && !role) at.report("expected a role of the VRM 1.0 humanoid, got \"" + name + "\"");
    return role;
}

// The body of that name; -1 (reported) when there is none. In version 1 the names are the roles'.
int readBodyName(const JsonCursor& at, const RagdollProfile& profile) {
    const std::string name = at.text();
    if (!at.readable()) return -1;
    const int body = bodyNamed(profile, name);
    if (body < 0) at.report(fmt::format("expected the name of one of the bodies, none is \"{}\"", name));
    return body;
}

void readName(const JsonCursor& at, const RagdollProfile& profile, BodyProfile& body) {
    body.name = at["name"].text();
    if (at["name"].readable() && bodyNamed(profile, body.name) >= 0)
        at["name"].report("expected a name of its own, another body is named \"" + body.name + "\"");
    if (at.has("mirror")) body.mirror = at["mirror"].text();
}

void takeNumber(const JsonCursor& at, const char* key, float most, float& out) {
    if (at.has(key)) out = at[key].number(0.0F, most);
}

MuscleFactors readFactors(const JsonCursor& at) {
    at.expectObject({}, {"strength", "damping", "torque"});
    MuscleFactors factors;
    takeNumber(at, "strength", MuscleFactors::kMost, factors.strength);
    takeNumber(at, "damping", MuscleFactors::kMost, factors.damping);
    takeNumber(at, "torque", MuscleFactors::kMost, factors.torque);
    return factors;
}

// What is not said is the preset's, and without one the powered doll's.
MuscleProfile readMuscles(const JsonCursor& at) {
    at.expectObject(
        {}, {"preset", "frequencyHz", "dampingRatio", "strength", "torque", "bounded", "carriesGravity", "groups"});
    MuscleProfile muscles;
    if (at.has("preset")) {
        const int preset = at["preset"].oneOf({"limp", "weak", "powered", "stiff"});
        if (preset >= 0) muscles = muscleProfileOf(static_cast<MusclePreset>(preset));
    }
    takeNumber(at, "frequencyHz", MuscleProfile::kMostHz, muscles.frequencyHz);
    takeNumber(at, "dampingRatio", MuscleFactors::kMost, muscles.dampingRatio);
    takeNumber(at, "strength", MuscleFactors::kMost, muscles.strength);
    takeNumber(at, "torque", MuscleFactors::kMost, muscles.torque);
    if (at.has("bounded")) muscles.bounded = at["bounded"].truth().value_or(muscles.bounded);
    if (at.has("carriesGravity")) muscles.carriesGravity = at["carriesGravity"].truth().value_or(false);
    if (!at.has("groups")) return muscles;
    const JsonCursor groups = at["groups"];
    groups.expectObject({}, {"trunk", "head", "arm", "leg"});
    for (std::size_t group = 0; group < muscles.groups.size(); ++group) {
        const std::string name(kMuscleGroupNames[group]);
        if (groups.has(name.c_str())) muscles.groups[group] = readFactors(groups[name.c_str()]);
    }
    return muscles;
}

// Whether a path ends with a joint's name: in full, or as that of a further sibling of the name ("arm#2").
bool isLastStep(std::string_view joint, std::string_view path) {
    const auto endsAsStep = [&](std::string_view ending) {
        if (!ending.ends_with(joint)) return false;
        const std::string_view before = ending.substr(0, ending.size() - joint.size());
        return before.empty() || before.back() == '/';
    };
    if (endsAsStep(path)) return true;
    const std::size_t digits = path.find_last_not_of("0123456789");
    const bool numbered = digits != std::string_view::npos && digits + 1 < path.size() && path[digits] == '#';
    return numbered && endsAsStep(path.substr(0, digits));
}

void readBody(const JsonCursor& at, RagdollProfile& profile, std::int64_t version) {
    BodyProfile body;
    if (version == 1) {
        at.expectObject({"role", "joint", "jointPath", "shape", "jointFromBody", "massKg", "inertia"});
    } else {
        at.expectObject({"name", "joint", "jointPath", "shape", "jointFromBody", "massKg", "inertia"},
                        {"role", "mirror", "muscle", "pinForceN"});
        readName(at, profile, body);
        if (at.has("muscle")) body.muscle = readFactors(at["muscle"]);
        if (at.has("pinForceN")) body.pinForceN = at["pinForceN"].number(0.0F, kLargest);
    }
    if (version == 1 || at.has("role")) {
        body.role = readRole(at["role"]);
        if (body.role && bodyOf(profile, *body.role) >= 0) {
            at["role"].report(
                fmt::format("expected a role of its own, there is a body for {} before", roleName(*body.role)));
        }
        if (version == 1 && body.role) setRole(body, *body.role);
    }
    body.joint = at["joint"].text();
    body.jointPath = at["jointPath"].text();
    if (!body.joint.empty() && !body.jointPath.empty() && !isLastStep(body.joint, body.jointPath))
        at["joint"].report("expected the last name of jointPath \"" + body.jointPath + "\"; they name two joints");
    const auto sameJoint = [&](const BodyProfile& other) { return other.jointPath == body.jointPath; };
    if (std::any_of(profile.bodies.begin(), profile.bodies.end(), sameJoint)) {
        at["jointPath"].report("expected a joint of its own, another body is on \"" + body.jointPath + "\"");
    }
    body.shape = readShape(at["shape"], version);
    body.jointFromBody = readFrame(at["jointFromBody"]);
    body.massKg = at["massKg"].number(kSmallest, kLargest);
    body.inertia = readVector(at["inertia"], kSmallest * kSmallest, kLargest);
    profile.bodies.push_back(std::move(body));
}

JointSpring readSpring(const JsonCursor& at) {
    at.expectObject({"stiffness", "damping", "rest"});
    JointSpring spring;
    spring.stiffness = at["stiffness"].number(0.0F, kLargest);
    spring.damping = at["damping"].number(0.0F, kLargest);
    spring.rest = readQuaternion(at["rest"]);
    return spring;
}

void readConstraint(const JsonCursor& at, RagdollProfile& profile, std::int64_t version) {
    constexpr float kAlmostPi = kPi - 1e-4F;
    constexpr float kTinyAngle = 1e-4F;
    const int kind = at["kind"].oneOf({"hinge", "coneTwist"});
    const char* limits = kind == 0 ? "hinge" : "cone";
    if (version == 1)
        at.expectObject({"child", "parent", "kind", "parentFromFrame", "childFromFrame", limits, "frictionNm"});
    else
        at.expectObject({"child", "parent", "kind", "parentFromFrame", "childFromFrame", limits, "frictionNm"},
                        {"spring"});
    ConstraintProfile c;
    c.kind = kind == 0 ? ConstraintProfile::Kind::hinge : ConstraintProfile::Kind::coneTwist;
    c.child = readBodyName(at["child"], profile);
    c.parent = readBodyName(at["parent"], profile);
    if (c.child == 0) at["child"].report("expected a body beside the first, the root, which hangs on nothing");
    if (c.child > 0 && c.parent >= c.child) {
        at["parent"].report("expected a body listed before the child (otherwise the links form a cycle)");
    }
    const auto sameChild = [&](const ConstraintProfile& other) { return other.child == c.child; };
    if (c.child > 0 && std::any_of(profile.constraints.begin(), profile.constraints.end(), sameChild)) {
        at["child"].report("expected one constraint a child, there is one before");
    }
    c.parentFromFrame = readFrame(at["parentFromFrame"]);
    c.childFromFrame = readFrame(at["childFromFrame"]);
    const JsonCursor range = at[limits];
    if (kind == 0) {
        range.expectObject({"lower", "upper"});
        c.hinge = {range["lower"].number(-kPi, 0.0F), range["upper"].number(0.0F, kPi)};
    } else if (kind == 1) {
        range.expectObject({"swingY", "swingZ", "twist"});
        c.cone = {range["swingY"].number(kTinyAngle, kAlmostPi), range["swingZ"].number(kTinyAngle, kAlmostPi),
                  range["twist"].number(kTinyAngle, kAlmostPi)};
    }
    c.frictionNm = at["frictionNm"].number(0.0F, kLargest);
    if (at.has("spring")) c.spring = readSpring(at["spring"]);
    profile.constraints.push_back(c);
}

// Every body but the first hangs on something, and the constraints follow their children's order.
void orderConstraints(const JsonCursor& at, RagdollProfile& profile) {
    for (std::size_t body = 1; body < profile.bodies.size(); ++body) {
        const auto isMine = [&](const ConstraintProfile& c) { return c.child == static_cast<int>(body); };
        // A body without a name, or with another's, has been reported for it.
        const std::string& name = profile.bodies[body].name;
        if (name.empty() || bodyNamed(profile, name) != static_cast<int>(body)) continue;
        if (std::none_of(profile.constraints.begin(), profile.constraints.end(), isMine))
            at.report(fmt::format("expected a constraint whose child is {}: it has no parent", name));
    }
    std::stable_sort(profile.constraints.begin(), profile.constraints.end(),
                     [](const auto& a, const auto& b) { return a.child < b.child; });
}

void readPair(const JsonCursor& at, RagdollProfile& profile) {
    if (!at.expectArray(2, 2)) return;
    const int a = readBodyName(at[std::size_t{0}], profile);
    const int b = readBodyName(at[std::size_t{1}], profile);
    if (a >= 0 && a == b) at.report("expected two different bodies");
    profile.filteredPairs.emplace_back(std::min(a, b), std::max(a, b));
}

void readHeader(const JsonCursor& at, RagdollProfile& profile, std::int64_t version) {
    const auto expect = [&](std::initializer_list<const char*> optional) {
        at.expectObject({"format", "version", "units", "name", "heightM", "totalMassKg", "standardFromModel", "bodies",
                         "constraints", "filteredPairs", "notes"},
                        optional);
    };
    if (version == 1) {
        expect({"$schema"});
    } else {
        expect({"$schema", "muscles"});
        if (at.has("muscles")) profile.muscles = readMuscles(at["muscles"]);
    }
    if (at.has("$schema")) static_cast<void>(at["$schema"].text());
    const JsonCursor units = at["units"];
    units.expectObject({"length", "mass", "angle", "torque"});
    units["length"].oneOf({"m"});
    units["mass"].oneOf({"kg"});
    units["angle"].oneOf({"rad"});
    units["torque"].oneOf({"N m"});
    profile.name = at["name"].text();
    profile.heightM = at["heightM"].number(kSmallest, kLargest);
    profile.totalMassKg = at["totalMassKg"].number(kSmallest, kLargest);
    profile.standardFromModel = readQuaternion(at["standardFromModel"]);
}

void readLists(const JsonCursor& at, RagdollProfile& profile, std::int64_t version) {
    const JsonCursor bodies = at["bodies"];
    if (bodies.expectArray(1, RagdollProfile::kMostBodies)) {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            readBody(bodies[i], profile, version);
        if (hasRoles(profile) && profile.bodies[0].role != Role::hips)
            bodies[std::size_t{0}]["role"].report("expected hips, the root");
    }
    const JsonCursor constraints = at["constraints"];
    if (constraints.expectArray(0, RagdollProfile::kMostBodies)) {
        for (std::size_t i = 0; i < constraints.size(); ++i)
            readConstraint(constraints[i], profile, version);
        orderConstraints(constraints, profile);
    }
    const JsonCursor pairs = at["filteredPairs"];
    if (pairs.expectArray(0, profile_format::kMostPairs)) {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            readPair(pairs[i], profile);
    }
    const JsonCursor notes = at["notes"];
    if (notes.expectArray(0, profile_format::kMostPairs)) {
        for (std::size_t i = 0; i < notes.size(); ++i)
            profile.notes.push_back(notes[i].text());
    }
}

constexpr JsonDocumentKind kProfileDocument{"ragdoll profile", "docs/profile.md describes every field"};

}  // namespace

Result<RagdollProfile> profileFromJson(std::string_view text, std::string_view source) {
    std::vector<std::string> duplicates;
    const Result<json> parsed = parseJson(text, source, duplicates);
    if (!parsed) return parsed.error();
    const json& document = parsed.value();
    std::vector<std::string> problems =
        checkFormat(document, profile_format::kName, RagdollProfile::kVersion, RagdollProfile::kOldestVersion);
    if (!problems.empty()) return refusedDocument(kProfileDocument, source, problems);
    problems = duplicates;
    RagdollProfile profile;
    const JsonCursor root(document, problems);
    const auto version = document["version"].get<std::int64_t>();
    readHeader(root, profile, version);
    readLists(root, profile, version);
    if (problems.empty()) problems = validate(profile);
    if (!problems.empty()) return refusedDocument(kProfileDocument, source, problems);
    return profile;
}

Result<RagdollProfile> loadProfile(const std::filesystem::path& file) {
    constexpr std::size_t kMostBytes = std::size_t{16} << 20U;
    const Result<std::vector<unsigned char>> bytes = readFile(file, kMostBytes);
    if (!bytes) return bytes.error();
    const auto* text = reinterpret_cast<const char*>(bytes.value().data());
    return profileFromJson({text, bytes.value().size()}, file.string());
}

}  // namespace lutka::physics
