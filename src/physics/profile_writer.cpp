#include <charconv>
#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "physics/profile_format.hpp"
#include "physics/profile_io.hpp"

namespace lutka::physics {
namespace {

using Json = nlohmann::ordered_json;

// The double whose shortest decimal is the float's shortest decimal: 0.1F becomes 0.1, not 0.10000000149011612, and
// reads back as the same float.
Json number(float value) {
    if (value == 0.0F) return 0.0;  // no sign
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    double wide = 0.0;
    std::from_chars(text, end, wide);
    return wide;
}

Json vector(const vec3& v) {
    return Json::array({number(v.x), number(v.y), number(v.z)});
}

Json quaternion(const quat& q) {
    return Json::array({number(q.x), number(q.y), number(q.z), number(q.w)});
}

Json frame(const RigidTransform& t) {
    return Json{{"rotation", quaternion(t.rotation)}, {"translation", vector(t.translation)}};
}

Json shape(const BodyShape& s) {
    switch (s.kind) {
        case BodyShape::Kind::capsule:
            return Json{{"kind", "capsule"}, {"radius", number(s.radius)}, {"halfLength", number(s.halfLength)}};
        case BodyShape::Kind::sphere:
            return Json{{"kind", "sphere"}, {"radius", number(s.radius)}};
        case BodyShape::Kind::box:
            break;
    }
    return Json{{"kind", "box"}, {"halfExtents", vector(s.halfExtents)}};
}

Json body(const BodyProfile& b) {
    return Json{{"role", roleName(b.role)},
                {"joint", b.joint},
                {"jointPath", b.jointPath},
                {"shape", shape(b.shape)},
                {"jointFromBody", frame(b.jointFromBody)},
                {"massKg", number(b.massKg)},
                {"inertia", vector(b.inertia)}};
}

Json constraint(const RagdollProfile& profile, const ConstraintProfile& c) {
    const bool hinge = c.kind == ConstraintProfile::Kind::hinge;
    Json json{{"child", roleName(profile.bodies[c.child].role)},
              {"parent", roleName(profile.bodies[c.parent].role)},
              {"kind", hinge ? "hinge" : "coneTwist"},
              {"parentFromFrame", frame(c.parentFromFrame)},
              {"childFromFrame", frame(c.childFromFrame)}};
    if (hinge) {
        json["hinge"] = Json{{"lower", number(c.hinge.lower)}, {"upper", number(c.hinge.upper)}};
    } else {
        json["cone"] =
            Json{{"swingY", number(c.cone.swingY)}, {"swingZ", number(c.cone.swingZ)}, {"twist", number(c.cone.twist)}};
    }
    json["frictionNm"] = number(c.frictionNm);
    return json;
}

bool isFlat(const Json& json) {
    for (const Json& item : json)
        if (item.is_structured()) return false;
    return true;
}

// Like dump(2), with arrays of plain values on one line: a change of one number is a change of one line.
void write(const Json& json, int depth, std::string& out) {
    constexpr auto kReplace = Json::error_handler_t::replace;
    if (!json.is_structured() || json.empty()) {
        out += json.dump(-1, ' ', false, kReplace);
        return;
    }
    if (json.is_array() && isFlat(json)) {
        out += '[';
        for (std::size_t i = 0; i < json.size(); ++i)
            out += (i > 0 ? ", " : "") + json[i].dump(-1, ' ', false, kReplace);
        out += ']';
        return;
    }
    const std::string indent(static_cast<std::size_t>(2 * (depth + 1)), ' ');
    out += json.is_object() ? '{' : '[';
    bool first = true;
    for (const auto& [key, value] : json.items()) {
        out += (first ? "\n" : ",\n") + indent;
        if (json.is_object()) out += Json(key).dump(-1, ' ', false, kReplace) + ": ";
        write(value, depth + 1, out);
        first = false;
    }
    out += '\n' + std::string(static_cast<std::size_t>(2 * depth), ' ') + (json.is_object() ? '}' : ']');
}

}  // namespace

std::string profileToJson(const RagdollProfile& profile) {
    Json json{{"$schema", profile_format::kSchema},
              {"format", profile_format::kName},
              {"version", RagdollProfile::kVersion},
              {"units", {{"length", "m"}, {"mass", "kg"}, {"angle", "rad"}, {"torque", "N m"}}},
              {"name", profile.name},
              {"heightM", number(profile.heightM)},
              {"totalMassKg", number(profile.totalMassKg)},
              {"standardFromModel", quaternion(profile.standardFromModel)}};
    json["bodies"] = Json::array();
    for (const BodyProfile& b : profile.bodies)
        json["bodies"].push_back(body(b));
    json["constraints"] = Json::array();
    for (const ConstraintProfile& c : profile.constraints)
        json["constraints"].push_back(constraint(profile, c));
    json["filteredPairs"] = Json::array();
    for (const auto& [first, second] : profile.filteredPairs) {
        json["filteredPairs"].push_back(
            Json::array({roleName(profile.bodies[first].role), roleName(profile.bodies[second].role)}));
    }
    json["notes"] = profile.notes;
    std::string out;
    write(json, 0, out);
    return out + '\n';
}

Result<void> saveProfile(const std::filesystem::path& file, const RagdollProfile& profile) {
    return writeFileAtomically(file, profileToJson(profile));
}

}  // namespace lutka::physics
