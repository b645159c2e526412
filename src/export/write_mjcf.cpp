#include "export/write_mjcf.hpp"

#include <glm/geometric.hpp>

#include "core/markup_text.hpp"
#include "export/doll_layout.hpp"
#include "export/text_builder.hpp"
#include "export/three_hinges.hpp"

namespace lutka::exporting {
namespace {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::PrimitiveShape;
using physics::RagdollProfile;

class MjcfWriter {
  public:
    explicit MjcfWriter(const ExportSource& source)
        : source_(source), profile_(source.profile), children_(profile_.bodies.size()) {
        for (const ConstraintProfile& constraint : profile_.constraints)
            children_[constraint.parent].push_back(constraint.child);
    }

    Exported write() {
        text_.line("<mujoco model=\"{}\">", markupEscaped(profile_.name));
        text_.indent();
        header();
        meshes();
        world();
        excludes();
        sums();
        keyframe();
        text_.outdent();
        text_.line("</mujoco>");
        return {text_.take(), std::move(warnings_)};
    }

  private:
    void header() {
        // Of two geoms that with more priority has the say, so that the doll slides alike on any ground.
        text_.line("<compiler angle=\"radian\" inertiafromgeom=\"false\"/>");
        text_.line("<option timestep=\"0.002\" gravity=\"0 0 -9.81\"/>");
        text_.line("<default>");
        text_.line("  <joint armature=\"0\" damping=\"0\"/>");
        text_.line("  <geom condim=\"3\" priority=\"1\" friction=\"{} 0.005 0.0001\"/>", numberText(kContactFriction));
        text_.line("</default>");
    }

    // The hulls, of which MuJoCo makes the faces.
    void meshes() {
        std::vector<std::pair<std::string, const PrimitiveShape*>> hulls;
        for (std::size_t i = 0; i < profile_.bodies.size(); ++i) {
            const std::string name = bodyName(profile_, static_cast<int>(i));
            const physics::BodyShape& shape = profile_.bodies[i].shape;
            if (shape.kind == PrimitiveShape::Kind::hull) hulls.emplace_back(name, &shape);
            for (std::size_t k = 0; k < shape.more.size(); ++k)
                if (shape.more[k].kind == PrimitiveShape::Kind::hull)
                    hulls.emplace_back(addedName(name, k), &shape.more[k]);
        }
        if (hulls.empty()) return;
        text_.line("<asset>");
        for (const auto& [name, shape] : hulls)
            text_.line("  <mesh name=\"{}\" vertex=\"{}\"/>", name, pointsText(*shape->hull));
        text_.line("</asset>");
    }

    void world() {
        text_.line("<worldbody>");
        text_.indent();
        text_.line("<light pos=\"0 0 4\" dir=\"0 0 -1\" directional=\"true\"/>");
        text_.line("<geom name=\"floor\" type=\"plane\" size=\"0 0 1\" rgba=\"0.5 0.5 0.5 1\"/>");
        body(0, standing(neutralPose(source_)));
        text_.outdent();
        text_.line("</worldbody>");
    }

    // The first body in the z-up world, with the lowest point of the whole pose on the floor.
    RigidTransform standing(const std::vector<RigidTransform>& modelFromBody) const {
        const quat worldFromModel = glm::normalize(zUpFromStandard() * profile_.standardFromModel);
        const vec3 up = glm::conjugate(worldFromModel) * vec3(0, 0, 1);
        const float lowest = lowestPoint(profile_, modelFromBody, up);
        const RigidTransform& hips = modelFromBody[0];
        return {glm::normalize(worldFromModel * hips.rotation), vec3(0, 0, glm::dot(hips.translation, up) - lowest)};
    }

    void body(int index, const RigidTransform& parentFromBody) {
        const BodyProfile& b = profile_.bodies[index];
        text_.line("<body name=\"{}\" pos=\"{}\" quat=\"{}\">", bodyName(profile_, index),
                   vectorText(parentFromBody.translation), quaternionTextWxyz(parentFromBody.rotation));
        text_.indent();
        if (index == 0) {
            text_.line("<freejoint name=\"root\"/>");
        } else {
            joints(profile_.constraints[index - 1]);
        }
        text_.line("<inertial pos=\"0 0 0\" mass=\"{}\" diaginertia=\"{}\"/>", numberText(b.massKg),
                   vectorText(b.inertia));
        shapes(index);
        for (const int child : children_[index])
            body(child, neutralParentFromChild(profile_.constraints[child - 1]));
        text_.outdent();
        text_.line("</body>");
    }

    // A capsule of theirs lies along z.
    void shapes(int index) {
        const std::string name = bodyName(profile_, index);
        const physics::BodyShape& all = profile_.bodies[index].shape;
        const bool capsule = all.kind == PrimitiveShape::Kind::capsule;
        shape(name, all, capsule ? " quat=\"0.70710678118654752 -0.70710678118654752 0 0\"" : "");
        for (std::size_t i = 0; i < all.more.size(); ++i) {
            const physics::AddedShape& added = all.more[i];
            RigidTransform place = added.bodyFromShape;
            if (added.kind == PrimitiveShape::Kind::capsule)
                place.rotation = place.rotation * glm::angleAxis(-0.5F * kPi, vec3(1, 0, 0));
            shape(addedName(name, i), added,
                  fmt::format(" pos=\"{}\" quat=\"{}\"", vectorText(place.translation),
                              quaternionTextWxyz(place.rotation)));
        }
    }
    void shape(const std::string& name, const PrimitiveShape& s, const std::string& place) {
        const auto geom = [&](std::string_view type, const std::string& size) {
            text_.line("<geom name=\"{}\" type=\"{}\" size=\"{}\"{}/>", name, type, size, place);
        };
        switch (s.kind) {
            case PrimitiveShape::Kind::capsule:
                return geom("capsule", numberText(s.radius) + " " + numberText(s.halfLength));
            case PrimitiveShape::Kind::sphere:
                return geom("sphere", numberText(s.radius));
            case PrimitiveShape::Kind::box:
                return geom("box", vectorText(s.halfExtents));
            case PrimitiveShape::Kind::hull:
                text_.line("<geom name=\"{0}\" type=\"mesh\" mesh=\"{0}\"{1}/>", name, place);
                return;
        }
    }

    void hinge(const std::string& name, const ConstraintProfile& c, const vec3& axis, float low, float high) {
        text_.line(
            "<joint name=\"{}\" type=\"hinge\" pos=\"{}\" axis=\"{}\" limited=\"true\" range=\"{} {}\" "
            "frictionloss=\"{}\"/>",
            name, vectorText(c.childFromFrame.translation), vectorText(c.childFromFrame.rotation * axis),
            numberText(low), numberText(high), numberText(c.frictionNm));
    }

    void joints(const ConstraintProfile& c) {
        const std::string name = bodyName(profile_, c.child);
        if (c.kind == ConstraintProfile::Kind::hinge) {
            hinge(name, c, {0, 0, 1}, c.hinge.lower, c.hinge.upper);
            return;
        }
        const ThreeHinges three = threeHinges(c.cone);
        const char* const first = three.yFirst ? "y" : "z";
        const char* const second = three.yFirst ? "z" : "y";
        hinge(name + "_" + first, c, three.yFirst ? vec3(0, 1, 0) : vec3(0, 0, 1), -three.firstMax, three.firstMax);
        hinge(name + "_" + second, c, three.yFirst ? vec3(0, 0, 1) : vec3(0, 1, 0), -three.secondMax, three.secondMax);
        hinge(name + "_x", c, {1, 0, 0}, -three.twistMax, three.twistMax);
        warnings_.push_back(
            fmt::format("{}: the elliptic cone is an octagon, up to {:.1f} degrees wider (a rectangle, {:.1f}, for who "
                        "does not read tendons); twist is up to {:.1f} degrees off at the rim",
                        name, degrees(three.octagonExcess), degrees(three.rectangleExcess), degrees(three.twistError)));
        if (three.secondMax > radians(80.0F)) {
            warnings_.push_back(
                fmt::format("{}: swings of {:.0f} degrees come near the right angle, where three hinges lock", name,
                            degrees(three.secondMax)));
        }
    }

    void excludes() {
        text_.line("<contact>");
        for (const ConstraintProfile& c : profile_.constraints)
            exclude(c.parent, c.child);
        for (const auto& [first, second] : profile_.filteredPairs)
            exclude(first, second);
        text_.line("</contact>");
    }
    void exclude(int a, int b) {
        text_.line("  <exclude body1=\"{}\" body2=\"{}\"/>", bodyName(profile_, a), bodyName(profile_, b));
    }

    // The octagon's slanting sides: sums of the two swings.
    void sums() {
        text_.line("<tendon>");
        text_.indent();
        for (const ConstraintProfile& c : profile_.constraints) {
            if (c.kind == ConstraintProfile::Kind::hinge) continue;
            const ThreeHinges three = threeHinges(c.cone);
            const std::string name = bodyName(profile_, c.child);
            for (const float sign : {1.0F, -1.0F}) {
                text_.line("<fixed name=\"{}_{}\" limited=\"true\" range=\"-1 1\">", name,
                           sign > 0.0F ? "sum" : "difference");
                text_.line("  <joint joint=\"{}_{}\" coef=\"{}\"/>", name, three.yFirst ? "y" : "z",
                           numberText(three.sumFirst));
                text_.line("  <joint joint=\"{}_{}\" coef=\"{}\"/>", name, three.yFirst ? "z" : "y",
                           numberText(sign * three.sumSecond));
                text_.line("</fixed>");
            }
        }
        text_.outdent();
        text_.line("</tendon>");
    }

    // The model's own bind pose; the bodies above stand in the neutral pose, where all angles are zero. Values come in
    // the order of the tree, as the bodies are written.
    void keyframe() {
        const RigidTransform root = standing(source_.rig.bindModelFromBody);
        std::string qpos = vectorText(root.translation) + " " + quaternionTextWxyz(root.rotation);
        appendAngles(0, qpos);
        text_.line("<keyframe>");
        text_.line("  <key name=\"bind\" qpos=\"{}\"/>", qpos);
        text_.line("</keyframe>");
    }
    void appendAngles(int body, std::string& qpos) const {
        for (const int child : children_[body]) {
            const ConstraintProfile& c = profile_.constraints[child - 1];
            if (c.kind == ConstraintProfile::Kind::hinge) {
                qpos += " " + numberText(bindHingeAngle(source_, c));
            } else {
                for (const float angle : hingeAngles(bindRotation(source_, c), threeHinges(c.cone).yFirst))
                    qpos += " " + numberText(angle);
            }
            appendAngles(child, qpos);
        }
    }

    const ExportSource& source_;
    const RagdollProfile& profile_;
    std::vector<std::vector<int>> children_;
    TextBuilder text_;
    std::vector<std::string> warnings_;
};

}  // namespace

Exported writeMjcf(const ExportSource& source) {
    return MjcfWriter(source).write();
}

}  // namespace lutka::exporting
