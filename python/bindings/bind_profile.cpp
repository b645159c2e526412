#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "animation/humanoid/roles.hpp"
#include "bindings/conversions.hpp"
#include "bindings/profile_object.hpp"
#include "bindings/sealed.hpp"
#include "physics/profile/profile_io.hpp"

namespace lutka::python {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::PrimitiveShape;
using physics::RagdollProfile;

void ProfileObject::edit(const std::function<void(RagdollProfile&)>& change) {
    RagdollProfile edited = profile_;
    change(edited);
    double mass = 0.0;
    for (const BodyProfile& body : edited.bodies)
        mass += static_cast<double>(body.massKg);
    edited.totalMassKg = static_cast<float>(mass);
    const std::vector<std::string> problems = physics::validate(edited);
    if (!problems.empty()) {
        raise({ErrorCode::usage, fmt::format("{}", fmt::join(problems, "; ")), "Profile " + profile_.name,
               "the profile is left as it was"});
    }
    profile_ = std::move(edited);
}

namespace {

using ProfilePointer = std::shared_ptr<ProfileObject>;

std::size_t bodyIndex(const ProfileObject& profile, const std::string& name) {
    const int body = physics::bodyNamed(profile.get(), name);
    if (body >= 0) return static_cast<std::size_t>(body);
    std::vector<std::string> names;
    for (const BodyProfile& other : profile.get().bodies)
        names.push_back(other.name);
    raise({ErrorCode::usage, fmt::format("there is no body '{}'", name), "Profile " + profile.get().name,
           fmt::format("its bodies are {}", fmt::join(names, ", "))});
}

std::vector<BodyObject> bodiesOf(const ProfilePointer& profile) {
    std::vector<BodyObject> bodies;
    for (std::size_t i = 0; i < profile->get().bodies.size(); ++i)
        bodies.push_back({profile, i});
    return bodies;
}

std::vector<ConstraintObject> constraintsOf(const ProfilePointer& profile) {
    std::vector<ConstraintObject> constraints;
    for (std::size_t i = 0; i < profile->get().constraints.size(); ++i)
        constraints.push_back({profile, i});
    return constraints;
}

// The constraint above a body.
ConstraintObject constraintOf(const ProfilePointer& profile, const std::string& name) {
    const std::size_t body = bodyIndex(*profile, name);
    if (body > 0) return {profile, body - 1};
    raise({ErrorCode::usage, fmt::format("'{}' is the root and hangs on nothing", name),
           "Profile " + profile->get().name, "every other body has a constraint"});
}

void setFiltered(ProfileObject& profile, const std::string& a, const std::string& b, bool filtered) {
    std::pair<int, int> pair{static_cast<int>(bodyIndex(profile, a)), static_cast<int>(bodyIndex(profile, b))};
    if (pair.first > pair.second) std::swap(pair.first, pair.second);
    profile.edit([&](RagdollProfile& edited) {
        auto& pairs = edited.filteredPairs;
        std::erase(pairs, pair);
        if (filtered) pairs.push_back(pair);
    });
}

ProfilePointer fromText(const std::string& text, const std::string& source) {
    return std::make_shared<ProfileObject>(orRaise(physics::profileFromJson(text, source)));
}

const char* shapeName(PrimitiveShape::Kind kind) {
    switch (kind) {
        case PrimitiveShape::Kind::capsule:
            return "capsule";
        case PrimitiveShape::Kind::sphere:
            return "sphere";
        case PrimitiveShape::Kind::hull:
            return "hull";
        case PrimitiveShape::Kind::box:
            break;
    }
    return "box";
}

void editBody(const BodyObject& body, const std::function<void(BodyProfile&)>& change) {
    body.profile->edit([&](RagdollProfile& profile) { change(profile.bodies[body.index]); });
}

// The moments keep their proportion to the mass.
void setMass(const BodyObject& body, float massKg) {
    editBody(body, [&](BodyProfile& edited) {
        edited.inertia *= massKg / edited.massKg;
        edited.massKg = massKg;
    });
}

void editConstraint(const ConstraintObject& constraint, const std::function<void(ConstraintProfile&)>& change) {
    constraint.profile->edit([&](RagdollProfile& profile) { change(profile.constraints[constraint.index]); });
}

void needsKind(const ConstraintObject& constraint, ConstraintProfile::Kind kind) {
    if (constraint.get().kind == kind) return;
    const bool hinge = kind == ConstraintProfile::Kind::hinge;
    raise({ErrorCode::usage,
           hinge ? "this joint is a cone and has no hinge limits" : "this joint is a hinge and has no cone",
           "Constraint of " + constraint.profile->get().bodies[constraint.index + 1].name,
           hinge ? "use cone = (swing_y, swing_z, twist)" : "use hinge = (lower, upper)"});
}

py::object hingeOf(const ConstraintObject& constraint) {
    const ConstraintProfile& c = constraint.get();
    if (c.kind != ConstraintProfile::Kind::hinge) return py::none();
    return py::make_tuple(c.hinge.lower, c.hinge.upper);
}

py::object coneOf(const ConstraintObject& constraint) {
    const ConstraintProfile& c = constraint.get();
    if (c.kind != ConstraintProfile::Kind::coneTwist) return py::none();
    return py::make_tuple(c.cone.swingY, c.cone.swingZ, c.cone.twist);
}

void bindBody(py::module_& module) {
    py::class_<BodyObject> body(module, "Body", py::is_final(),
                                "A rigid body of a profile: a live part of it, which it keeps alive.");
    neverMadeByItself(body, "a Body is a part of a Profile: profile.body(name)");
    body.def_property_readonly(
            "name", [](const BodyObject& b) { return b.get().name; }, "Unique in the profile.")
        .def_property_readonly(
            "role",
            [](const BodyObject& b) -> py::object {
                if (!b.get().role) return py::none();
                return py::str(std::string(animation::roleName(*b.get().role)));
            },
            "The part of a humanoid that it is (VRM's names), or None.")
        .def_property_readonly(
            "joint", [](const BodyObject& b) { return py::bytes(b.get().joint).attr("decode")("utf-8", "replace"); },
            "Name of the joint that it moves.")
        .def_property(
            "mass", [](const BodyObject& b) { return b.get().massKg; }, &setMass,
            "Kilograms, above 0. Setting it scales the inertia and changes the profile's total.")
        .def_property(
            "inertia", [](const BodyObject& b) { return b.get().inertia; },
            [](const BodyObject& b, const vec3& value) { editBody(b, [&](BodyProfile& e) { e.inertia = value; }); },
            "Principal moments about the body's axes, kg m².")
        .def_property_readonly(
            "shape", [](const BodyObject& b) { return shapeName(b.get().shape.kind); },
            "'capsule', 'box', 'sphere' or 'hull'.")
        .def_property(
            "radius", [](const BodyObject& b) { return b.get().shape.radius; },
            [](const BodyObject& b, float value) { editBody(b, [&](BodyProfile& e) { e.shape.radius = value; }); },
            "Metres; of capsules and spheres.")
        .def_property(
            "half_length", [](const BodyObject& b) { return b.get().shape.halfLength; },
            [](const BodyObject& b, float value) { editBody(b, [&](BodyProfile& e) { e.shape.halfLength = value; }); },
            "Metres, half the distance of a capsule's cap centres along the body's y.")
        .def_property(
            "half_extents", [](const BodyObject& b) { return b.get().shape.halfExtents; },
            [](const BodyObject& b, const vec3& value) {
                editBody(b, [&](BodyProfile& e) { e.shape.halfExtents = value; });
            },
            "Metres; of a box.")
        .def_property_readonly(
            "points",
            [](const BodyObject& b) -> py::object {
                const physics::ConvexHullPtr& hull = b.get().shape.hull;
                if (b.get().shape.kind != PrimitiveShape::Kind::hull) return py::none();
                py::list points;
                for (const vec3& point : hull->points())
                    points.append(py::make_tuple(point.x, point.y, point.z));
                return points;
            },
            "Corners of a hull in the body's axes, metres: a list of (x, y, z); None for other shapes.")
        .def_property_readonly(
            "shape_count", [](const BodyObject& b) { return 1 + b.get().shape.more.size(); },
            "1 to 3. shape, radius, half_length and half_extents are the main one's; to_json() holds all.")
        .def("__repr__", [](const BodyObject& b) {
            return fmt::format("<lutka.Body {}: {} of {:.3g} kg>", b.get().name, shapeName(b.get().shape.kind),
                               b.get().massKg);
        });
}

void bindConstraint(py::module_& module) {
    using Numbers2 = std::array<float, 2>;
    using Numbers3 = std::array<float, 3>;
    py::class_<ConstraintObject> constraint(module, "Constraint", py::is_final(),
                                            "What links two bodies: a live part of its profile.");
    neverMadeByItself(constraint, "a Constraint is a part of a Profile: profile.constraint(body)");
    constraint
        .def_property_readonly(
            "kind",
            [](const ConstraintObject& c) { return c.get().kind == ConstraintProfile::Kind::hinge ? "hinge" : "cone"; },
            "'hinge' or 'cone'.")
        .def_property_readonly(
            "parent",
            [](const ConstraintObject& c) {
                return BodyObject{c.profile, static_cast<std::size_t>(c.get().parent)};
            },
            "The body that the child hangs on.")
        .def_property_readonly(
            "child",
            [](const ConstraintObject& c) {
                return BodyObject{c.profile, c.index + 1};
            },
            "The body that is moved by this joint; a constraint is called by its name.")
        .def_property(
            "hinge", &hingeOf,
            [](const ConstraintObject& c, const Numbers2& limits) {
                needsKind(c, ConstraintProfile::Kind::hinge);
                editConstraint(c, [&](ConstraintProfile& e) { e.hinge = {limits[0], limits[1]}; });
            },
            "(lower, upper) in radians, lower in [-pi, 0] and upper in [0, pi]; None for a cone.")
        .def_property(
            "cone", &coneOf,
            [](const ConstraintObject& c, const Numbers3& limits) {
                needsKind(c, ConstraintProfile::Kind::coneTwist);
                editConstraint(c, [&](ConstraintProfile& e) { e.cone = {limits[0], limits[1], limits[2]}; });
            },
            "(swing_y, swing_z, twist) in radians, each in (0, pi); None for a hinge.")
        .def_property(
            "friction", [](const ConstraintObject& c) { return c.get().frictionNm; },
            [](const ConstraintObject& c, float value) {
                editConstraint(c, [&](ConstraintProfile& e) { e.frictionNm = value; });
            },
            "Largest torque of dry friction, N m, at least 0.")
        .def("__repr__", [](const ConstraintObject& c) {
            const RagdollProfile& profile = c.profile->get();
            return fmt::format("<lutka.Constraint {} on {}>", profile.bodies[c.index + 1].name,
                               profile.bodies[static_cast<std::size_t>(c.get().parent)].name);
        });
}

}  // namespace

void bindProfile(py::module_& module) {
    py::class_<ProfileObject, ProfilePointer> profile(module, "Profile", py::is_final(),
                                                      "A ragdoll's bodies, masses, shapes and limits. Always valid: a "
                                                      "change that makes no sense is refused and changes nothing.");
    neverMadeByItself(profile, "a Profile is read or fitted: Profile.load(file), or build(model).profile");
    bindBody(module);
    bindConstraint(module);
    profile
        .def_static(
            "load",
            [](const std::filesystem::path& file) {
                return std::make_shared<ProfileObject>(orRaise(physics::loadProfile(file)));
            },
            py::arg("file"), "Reads a *.ragdoll.json.")
        .def_static("from_json", &fromText, py::arg("text"), py::arg("source") = "text",
                    "Reads a profile's document; `source` names it in errors.")
        .def(
            "to_json", [](const ProfileObject& p) { return physics::profileToJson(p.get()); },
            "The profile's document (docs/profile.md).")
        .def(
            "save",
            [](const ProfileObject& p, const std::filesystem::path& file) {
                orRaise(physics::saveProfile(file, p.get()));
            },
            py::arg("file"), "Writes a *.ragdoll.json, whole or not at all.")
        .def_property_readonly(
            "name", [](const ProfileObject& p) { return py::bytes(p.get().name).attr("decode")("utf-8", "replace"); },
            "Of the figure that it was made for.")
        .def_property_readonly(
            "height", [](const ProfileObject& p) { return p.get().heightM; }, "Of the standing figure, metres.")
        .def_property_readonly(
            "mass", [](const ProfileObject& p) { return p.get().totalMassKg; }, "Of all bodies, kilograms.")
        .def_property_readonly("bodies", &bodiesOf, "Parents first; the root is bodies[0].")
        .def_property_readonly("constraints", &constraintsOf, "constraints[i] holds bodies[i + 1] to its parent.")
        .def(
            "body",
            [](const ProfilePointer& p, const std::string& name) {
                return BodyObject{p, bodyIndex(*p, name)};
            },
            py::arg("name"), "The body of that name.")
        .def("constraint", &constraintOf, py::arg("body"),
             "The constraint that holds the body of that name to its parent.")
        .def_property_readonly(
            "filtered_pairs",
            [](const ProfileObject& p) {
                std::vector<std::pair<std::string, std::string>> names;
                for (const auto& [a, b] : p.get().filteredPairs)
                    names.emplace_back(p.get().bodies[static_cast<std::size_t>(a)].name,
                                       p.get().bodies[static_cast<std::size_t>(b)].name);
                return names;
            },
            "Pairs of names of bodies that never collide, beside the linked ones.")
        .def("set_filtered", &setFiltered, py::arg("a"), py::arg("b"), py::arg("filtered") = true,
             "Whether the bodies of these names pass through each other.")
        .def(
            "copy", [](const ProfileObject& p) { return std::make_shared<ProfileObject>(p.get()); }, "One of its own.")
        .def("__copy__", [](const ProfileObject& p) { return std::make_shared<ProfileObject>(p.get()); })
        .def("__deepcopy__",
             [](const ProfileObject& p, const py::dict&) { return std::make_shared<ProfileObject>(p.get()); })
        .def(
            "__eq__",
            [](const ProfileObject& a, const ProfileObject& b) {
                return physics::profileToJson(a.get()) == physics::profileToJson(b.get());
            },
            py::is_operator())
        .def("__repr__", [](const ProfileObject& p) {
            return fmt::format("<lutka.Profile: {} bodies, {:.1f} kg, {:.2f} m>", p.get().bodies.size(),
                               p.get().totalMassKg, p.get().heightM);
        });
}

}  // namespace lutka::python
