#include "export/write_urdf.hpp"

#include <cmath>

#include "core/markup_text.hpp"
#include "export/doll_layout.hpp"
#include "export/text_builder.hpp"
#include "export/three_hinges.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::exporting {
namespace {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::PrimitiveShape;
using physics::RagdollProfile;

// Of the links between two hinges, which stand for nothing: small beside every body, yet not zero, which simulators
// refuse.
constexpr float kNoMass = 1e-3F;     // kg
constexpr float kNoInertia = 1e-6F;  // kg m²

// Fixed-axis angles: R = Rz(yaw) · Ry(pitch) · Rx(roll). In doubles and by arc tangents: thighs stand at a pitch of
// nearly a right angle, where an arc sine has half the digits.
std::string originText(const RigidTransform& t) {
    const glm::dmat3 m = glm::mat3_cast(glm::normalize(glm::dquat(t.rotation)));
    const double level = std::hypot(m[0][0], m[0][1]);
    const bool locked = level < 1e-7;  // yaw is free then: 0
    const double roll = locked ? std::atan2(-m[2][1], m[1][1]) : std::atan2(m[1][2], m[2][2]);
    const double pitch = std::atan2(-m[0][2], level);
    const double yaw = locked ? 0.0 : std::atan2(m[0][1], m[0][0]);
    return fmt::format("<origin xyz=\"{}\" rpy=\"{:.12g} {:.12g} {:.12g}\"/>", vectorText(t.translation), roll, pitch,
                       yaw);
}

class UrdfWriter {
  public:
    explicit UrdfWriter(const ExportSource& source) : source_(source), profile_(source.profile) {}

    Exported write() {
        text_.line("<?xml version=\"1.0\"?>");
        text_.line("<robot name=\"{}\">", markupEscaped(profile_.name));
        text_.indent();
        link(0);
        for (const ConstraintProfile& constraint : profile_.constraints) {
            joints(constraint);
            link(constraint.child);
        }
        text_.outdent();
        text_.line("</robot>");
        warnings_.emplace_back(
            "URDF has no ball joint: a cone is three hinges with two links of a gram between them, its ellipse a "
            "rectangle; no collision filter: put the pairs into your planner's or simulator's own");
        return {text_.take(), std::move(warnings_)};
    }

  private:
    // A link's frame is that of the joint that it hangs on, as URDF demands; the root's stands z-up.
    [[nodiscard]] RigidTransform linkFromBody(int body) const {
        if (body > 0) return inverse(profile_.constraints[body - 1].childFromFrame);
        const quat turn = zUpFromStandard() * profile_.standardFromModel * source_.rig.bindModelFromBody[0].rotation;
        return {glm::normalize(turn), vec3(0)};
    }

    void link(int index) {
        const BodyProfile& body = profile_.bodies[index];
        const RigidTransform origin = linkFromBody(index);
        text_.line("<link name=\"{}\">", bodyName(profile_, index));
        text_.indent();
        inertial(origin, body.massKg, body.inertia);
        for (const char* const use : {"visual", "collision"}) {
            visitShapes(body.shape, [&](const PrimitiveShape& shape, const RigidTransform& bodyFromShape) {
                geometry(use, origin * bodyFromShape, shape);
            });
        }
        visitShapes(body.shape, [&](const PrimitiveShape& shape, const RigidTransform&) {
            if (shape.kind != PrimitiveShape::Kind::hull) return;
            const bool box = physics::standInFor(*shape.hull).shape.kind == PrimitiveShape::Kind::box;
            warnings_.push_back(
                fmt::format("{}: a hull can't be written into the file; it is the {} of the same moments",
                            bodyName(profile_, index), box ? "box" : "capsule"));
        });
        // URDF has no friction of contacts. Bullet reads this one, and multiplies both sides'.
        text_.line("<contact><lateral_friction value=\"{}\"/></contact>", numberText(physics::kBodyFriction));
        text_.outdent();
        text_.line("</link>");
        // Gazebo's extension: it takes the less of both.
        text_.line("<gazebo reference=\"{}\"><mu1>{}</mu1><mu2>{}</mu2></gazebo>", bodyName(profile_, index),
                   numberText(kContactFriction), numberText(kContactFriction));
    }

    void inertial(const RigidTransform& origin, float massKg, const vec3& moments) {
        text_.line("<inertial>");
        text_.line("  {}", originText(origin));
        text_.line("  <mass value=\"{}\"/>", numberText(massKg));
        text_.line("  <inertia ixx=\"{}\" ixy=\"0\" ixz=\"0\" iyy=\"{}\" iyz=\"0\" izz=\"{}\"/>", numberText(moments.x),
                   numberText(moments.y), numberText(moments.z));
        text_.line("</inertial>");
    }

    void part(const char* use, const RigidTransform& origin, const std::string& shape) {
        text_.line("<{}>", use);
        text_.line("  {}", originText(origin));
        text_.line("  <geometry>{}</geometry>", shape);
        text_.line("</{}>", use);
    }

    // A capsule is a cylinder, which lies along z, and two spheres.
    void geometry(const char* use, const RigidTransform& origin, const PrimitiveShape& shape) {
        const std::string sphere = fmt::format("<sphere radius=\"{}\"/>", numberText(shape.radius));
        switch (shape.kind) {
            case PrimitiveShape::Kind::capsule:
                part(use, origin * RigidTransform{glm::angleAxis(-0.5F * kPi, vec3(1, 0, 0)), vec3(0)},
                     fmt::format("<cylinder radius=\"{}\" length=\"{}\"/>", numberText(shape.radius),
                                 numberText(2.0F * shape.halfLength)));
                for (const float end : {shape.halfLength, -shape.halfLength})
                    part(use, origin * RigidTransform{quat(1, 0, 0, 0), vec3(0, end, 0)}, sphere);
                return;
            case PrimitiveShape::Kind::sphere:
                part(use, origin, sphere);
                return;
            case PrimitiveShape::Kind::box:
                part(use, origin, fmt::format("<box size=\"{}\"/>", vectorText(2.0F * shape.halfExtents)));
                return;
            case PrimitiveShape::Kind::hull: {
                const physics::StandIn simple = physics::standInFor(*shape.hull);
                geometry(use, origin * simple.hullFromShape, simple.shape);
                return;
            }
        }
    }

    struct Hinge {
        std::string name, parent, child;
        RigidTransform origin;
        vec3 axis{0, 0, 1};
        float low = 0, high = 0;
    };
    void hinge(const Hinge& h, float frictionNm) {
        text_.line("<joint name=\"{}\" type=\"revolute\">", h.name);
        text_.indent();
        text_.line("{}", originText(h.origin));
        text_.line("<parent link=\"{}\"/>", h.parent);
        text_.line("<child link=\"{}\"/>", h.child);
        text_.line("<axis xyz=\"{}\"/>", vectorText(h.axis));
        text_.line("<limit lower=\"{}\" upper=\"{}\" effort=\"0\" velocity=\"100\"/>", numberText(h.low),
                   numberText(h.high));
        text_.line("<dynamics damping=\"0\" friction=\"{}\"/>", numberText(frictionNm));
        text_.outdent();
        text_.line("</joint>");
    }
    void emptyLink(const std::string& name) {
        text_.line("<link name=\"{}\">", name);
        text_.indent();
        inertial({}, kNoMass, vec3(kNoInertia));
        text_.outdent();
        text_.line("</link>");
    }

    void joints(const ConstraintProfile& c) {
        const std::string child = bodyName(profile_, c.child);
        const std::string parent = bodyName(profile_, c.parent);
        const RigidTransform origin = linkFromBody(c.parent) * c.parentFromFrame;
        if (c.kind == ConstraintProfile::Kind::hinge) {
            hinge({child + "_z", parent, child, origin, {0, 0, 1}, c.hinge.lower, c.hinge.upper}, c.frictionNm);
            return;
        }
        const ThreeHinges three = threeHinges(c.cone);
        const std::string first = child + (three.yFirst ? "_y" : "_z");
        const std::string second = child + (three.yFirst ? "_z" : "_y");
        const vec3 y(0, 1, 0);
        const vec3 z(0, 0, 1);
        emptyLink(first + "_link");
        hinge({first, parent, first + "_link", origin, three.yFirst ? y : z, -three.firstMax, three.firstMax},
              c.frictionNm);
        emptyLink(second + "_link");
        hinge({second, first + "_link", second + "_link", {}, three.yFirst ? z : y, -three.secondMax, three.secondMax},
              c.frictionNm);
        hinge({child + "_x", second + "_link", child, {}, {1, 0, 0}, -three.twistMax, three.twistMax}, c.frictionNm);
        warnings_.push_back(
            fmt::format("{}: the rectangle is up to {:.1f} degrees wider than the ellipse, twist up to "
                        "{:.1f} degrees off at the rim",
                        child, degrees(three.rectangleExcess), degrees(three.twistError)));
    }

    const ExportSource& source_;
    const RagdollProfile& profile_;
    TextBuilder text_;
    std::vector<std::string> warnings_;
};

}  // namespace

Exported writeUrdf(const ExportSource& source) {
    return UrdfWriter(source).write();
}

}  // namespace lutka::exporting
