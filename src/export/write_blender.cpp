#include "export/write_blender.hpp"

#include "export/doll_layout.hpp"
#include "export/text_builder.hpp"
#include "physics/profile/joint_range.hpp"

namespace lutka::exporting {
namespace {

using physics::AngleSpan;
using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::JointRange;
using physics::PrimitiveShape;
using physics::RagdollProfile;

// What does the work, below the tables. An armature is one that the user has imported: of the same model, in its
// rest pose, standing where BODIES stand.
constexpr std::string_view kBody = R"(

def matrix(place):
    """Location and rotation (w x y z) as a matrix."""
    return Matrix.Translation(place[0]) @ Quaternion(place[1]).to_matrix().to_4x4()


def outline(kind, size):
    """The corners that a rigid body takes its shape's size from; a capsule lies along z, a hull is its corners."""
    if kind == 'CONVEX_HULL':
        return size
    if kind == 'CAPSULE':
        r, half = size
        return [(r, 0, 0), (-r, 0, 0), (0, r, 0), (0, -r, 0), (0, 0, half + r), (0, 0, -half - r)]
    if kind == 'SPHERE':
        r = size[0]
        return [(r, 0, 0), (-r, 0, 0), (0, r, 0), (0, -r, 0), (0, 0, r), (0, 0, -r)]
    x, y, z = size
    return [(a * x, b * y, c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]


def add_to_world(kind):
    """The scene's collection of rigid bodies ('collection') or of their constraints ('constraints')."""
    scene = bpy.context.scene
    if scene.rigidbody_world is None:
        bpy.ops.rigidbody.world_add()
    world = scene.rigidbody_world
    if getattr(world, kind) is None:
        setattr(world, kind, bpy.data.collections.new('Rigid body ' + kind))
    return getattr(world, kind)


def add_body(name, kind, size, place, mass):
    mesh = bpy.data.meshes.new(name)
    corners = outline(kind, size)
    mesh.from_pydata(corners, [(0, i) for i in range(1, len(corners))], [])
    body = bpy.data.objects.new('body ' + name, mesh)
    bpy.context.scene.collection.objects.link(body)
    # A capsule of ours lies along y.
    turn = Matrix.Rotation(-pi / 2, 4, 'X') if kind == 'CAPSULE' else Matrix.Identity(4)
    body.matrix_world = matrix(place) @ turn
    body.display_type = 'WIRE'
    add_to_world('collection').objects.link(body)
    body.rigid_body.type = 'ACTIVE'
    body.rigid_body.collision_shape = kind
    body.rigid_body.use_margin = True
    body.rigid_body.collision_margin = 0.0
    body.rigid_body.mass = mass
    body.rigid_body.friction = 0.5  # Bullet multiplies both sides'
    body.rigid_body.linear_damping = 0.0
    body.rigid_body.angular_damping = 0.0
    return body


def add_constraint(name, kind, place, first, second):
    empty = bpy.data.objects.new('joint ' + name, None)
    empty.empty_display_size = 0.05
    empty.matrix_world = matrix(place)
    bpy.context.scene.collection.objects.link(empty)
    add_to_world('constraints').objects.link(empty)
    constraint = empty.rigid_body_constraint
    constraint.type = kind
    constraint.object1 = first
    constraint.object2 = second
    constraint.disable_collisions = True
    return constraint


def limit(constraint, axis, span):
    # Blender's angles run clockwise: Bullet tells them of the first body in the second.
    setattr(constraint, 'use_limit_ang_' + axis, True)
    setattr(constraint, 'limit_ang_%s_lower' % axis, -span[1])
    setattr(constraint, 'limit_ang_%s_upper' % axis, -span[0])


def add_joints(bodies):
    for child, parent, place, hinge, spans in JOINTS:
        constraint = add_constraint(child, 'HINGE' if hinge else 'GENERIC', place, bodies[parent], bodies[child])
        if hinge:
            limit(constraint, 'z', spans[2])
            continue
        for axis, span in zip('xyz', spans):
            setattr(constraint, 'use_limit_lin_' + axis, True)
            setattr(constraint, 'limit_lin_%s_lower' % axis, 0.0)
            setattr(constraint, 'limit_lin_%s_upper' % axis, 0.0)
            limit(constraint, axis, span)
    for first, second in APART:  # a constraint that allows everything but contact
        add_constraint(first + ' ' + second, 'GENERIC', (BODIES[0][3]), bodies[first], bodies[second])


def drive(armature, bodies):
    """Bones copy empties that hang on the bodies where the bones now are."""
    bpy.context.view_layer.update()
    for name, _, _, _, _, bone in BODIES:
        if bone not in armature.pose.bones:
            print('no bone named', bone)
            continue
        empty = bpy.data.objects.new('drive ' + name, None)
        bpy.context.scene.collection.objects.link(empty)
        empty.parent = bodies[name]
        empty.matrix_parent_inverse = bodies[name].matrix_world.inverted()
        empty.matrix_basis = armature.matrix_world @ armature.pose.bones[bone].matrix
        copy = armature.pose.bones[bone].constraints.new('COPY_TRANSFORMS')
        copy.target = empty


def add_floor():
    mesh = bpy.data.meshes.new('floor')
    mesh.from_pydata([(x, y, z) for x in (-20, 20) for y in (-20, 20) for z in (-0.5, 0.5)], [(0, 7)], [])
    floor = bpy.data.objects.new('floor', mesh)
    floor.location = (0, 0, -0.5)  # a box is centred on the object's origin, whatever the mesh
    bpy.context.scene.collection.objects.link(floor)
    add_to_world('collection').objects.link(floor)
    floor.rigid_body.type = 'PASSIVE'
    floor.rigid_body.collision_shape = 'BOX'
    floor.rigid_body.friction = 0.8
    return floor


def build(armature=None):
    """Adds bodies and joints; the armature's bones follow them. Returns the bodies' objects by name."""
    scene = bpy.context.scene
    bodies = {name: add_body(name, kind, size, place, mass) for name, kind, size, place, mass, _ in BODIES}
    add_joints(bodies)
    scene.rigidbody_world.substeps_per_frame = 40
    scene.rigidbody_world.solver_iterations = 50
    if armature is not None:
        drive(armature, bodies)
    return bodies


if __name__ == '__main__':
    chosen = bpy.context.object if bpy.context.object and bpy.context.object.type == 'ARMATURE' else None
    build(chosen)
    add_floor()
)";

std::string tupleText(std::initializer_list<float> values) {
    std::string text = "(";
    for (const float value : values)
        text += numberText(value) + ", ";
    return text + ")";
}

// Blender is z-up: its importers turn (x, y, z) into (x, -z, y).
RigidTransform blenderFromModel(const ExportSource& source) {
    return RigidTransform{glm::angleAxis(0.5F * kPi, vec3(1, 0, 0)), vec3(0)} * standingFromModel(source);
}

std::string placeText(const RigidTransform& t) {
    return fmt::format("(({}), ({}))", vectorText(t.translation, ", "), quaternionTextWxyz(t.rotation, ", "));
}

std::string shapeText(const PrimitiveShape& shape) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::capsule:
            return "'CAPSULE', " + tupleText({shape.radius, shape.halfLength});
        case PrimitiveShape::Kind::sphere:
            return "'SPHERE', " + tupleText({shape.radius});
        case PrimitiveShape::Kind::hull: {
            std::string corners;
            for (const vec3& point : shape.hull->points())
                corners += fmt::format("({}), ", vectorText(point, ", "));
            return "'CONVEX_HULL', [" + corners + "]";
        }
        case PrimitiveShape::Kind::box:
            break;
    }
    return fmt::format("'BOX', ({})", vectorText(shape.halfExtents, ", "));
}

std::string spanText(const AngleSpan& span) {
    return tupleText({span.low, span.high});
}

class BlenderWriter {
  public:
    explicit BlenderWriter(const ExportSource& source) : source_(source), profile_(source.profile) {}

    Exported write() {
        text_.line("# {}: a ragdoll of {} bodies for Blender, written by Lutka. Metres, kilograms, radians, z up.",
                   quotedText(profile_.name), profile_.bodies.size());
        text_.line(
            "# Import the model, select its armature in the rest pose, run this; without an armature the bodies come "
            "alone.");
        text_.block("from math import pi\n\nimport bpy\nfrom mathutils import Matrix, Quaternion\n\n");
        bodies();
        joints();
        text_.line("# Pairs that never collide, beside the joined ones.");
        text_.line("APART = [");
        for (const auto& [first, second] : profile_.filteredPairs)
            text_.line("    ({}, {}),", quotedText(bodyName(profile_, first)), quotedText(bodyName(profile_, second)));
        text_.line("]");
        text_.block(kBody);
        warnings_.emplace_back("moments of inertia are made by Blender from the shapes; joints have no friction");
        return {text_.take(), std::move(warnings_)};
    }

  private:
    void bodies() {
        text_.line("# Name, shape, its size, place (location, rotation w x y z), mass, bone.");
        text_.line("BODIES = [");
        for (std::size_t i = 0; i < profile_.bodies.size(); ++i) {
            const BodyProfile& b = profile_.bodies[i];
            text_.line("    ({}, {}, {}, {}, {}),", quotedText(bodyName(profile_, static_cast<int>(i))),
                       shapeText(b.shape), placeText(blenderFromModel(source_) * source_.rig.bindModelFromBody[i]),
                       numberText(b.massKg), quotedText(b.joint));
            if (!b.shape.more.empty())
                warnings_.push_back(fmt::format("{}: a rigid body has one shape here, {} more of it are left out",
                                                bodyName(profile_, static_cast<int>(i)), b.shape.more.size()));
        }
        text_.line("]");
    }

    // The frame is one for both bodies: the child's in the bind pose. Limits are told from there.
    void joints() {
        text_.line("# Child, parent, place, whether a hinge, ranges about x, y and z from the bind pose.");
        text_.line("JOINTS = [");
        for (const ConstraintProfile& c : profile_.constraints) {
            const JointRange range = physics::jointRange(
                c, {source_.rig.bindModelFromBody[c.parent], source_.rig.bindModelFromBody[c.child]});
            const bool hinge = c.kind == ConstraintProfile::Kind::hinge;
            const RigidTransform place =
                blenderFromModel(source_) * source_.rig.bindModelFromBody[c.child] * c.childFromFrame;
            text_.line("    ({}, {}, {}, {}, ({}, {}, {})),", quotedText(bodyName(profile_, c.child)),
                       quotedText(bodyName(profile_, c.parent)), placeText(place), hinge ? "True" : "False",
                       spanText(range.twist), spanText(range.side), spanText(range.flexion));
            if (!hinge)
                warnings_.push_back(
                    fmt::format("{}: the elliptic cone is a range for each of three angles from the bind pose",
                                bodyName(profile_, c.child)));
        }
        text_.line("]");
    }

    const ExportSource& source_;
    const RagdollProfile& profile_;
    TextBuilder text_;
    std::vector<std::string> warnings_;
};

}  // namespace

Exported writeBlender(const ExportSource& source) {
    return BlenderWriter(source).write();
}

}  // namespace lutka::exporting
