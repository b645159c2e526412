#include "export/write_godot.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <set>

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

constexpr int kHingeJoint = 3;
constexpr int kSixDofJoint = 5;

// What the scene file can't hold: pairs that never collide, the start, and (Godot 4) the skin of a model beside it.
constexpr std::string_view kScriptThree = R"(extends Spatial

export(PoolStringArray) var exceptions

func _ready():
	for i in range(0, exceptions.size(), 2):
		var body = $Skeleton.get_node(exceptions[i])
		body.add_collision_exception_with($Skeleton.get_node(exceptions[i + 1]))
	$Skeleton.physical_bones_start_simulation()
)";

constexpr std::string_view kScriptFour = R"(extends Node3D

@export var exceptions: PackedStringArray
## The same character as a scene, of which the meshes are taken: lutka export MODEL -o NAME.glb
@export var model: PackedScene

func _ready():
	if model:
		_take_meshes(model.instantiate())
	var simulator = $Skeleton3D/PhysicalBoneSimulator3D
	for i in range(0, exceptions.size(), 2):
		var body = simulator.get_node(exceptions[i])
		body.add_collision_exception_with(simulator.get_node(exceptions[i + 1]))
	simulator.physical_bones_start_simulation()

func _take_meshes(scene):
	for mesh in scene.find_children("*", "MeshInstance3D", true, false):
		mesh.owner = null
		mesh.reparent($Skeleton3D, false)
		mesh.skeleton = NodePath("..")
	scene.free()
)";

class GodotWriter {
  public:
    GodotWriter(const ExportSource& source, GodotVersion version)
        : source_(source), profile_(source.profile), four_(version == GodotVersion::four) {}

    Exported write() {
        nameBones();
        placeShapes();
        text_.line("[gd_scene load_steps={} format={}]", shapes_.size() + 2, four_ ? 3 : 2);
        resources();
        text_.blank();
        text_.line("[node name=\"Ragdoll\" type=\"{}\"]", four_ ? "Node3D" : "Spatial");
        text_.line("script = SubResource({})", idText(0));
        text_.line("exceptions = {}( {} )", four_ ? "PackedStringArray" : "PoolStringArray", exceptionList());
        skeleton();
        for (std::size_t i = 0; i < profile_.bodies.size(); ++i)
            body(static_cast<int>(i));
        warnings_.emplace_back("moments of inertia are made by the engine from the shapes; joints have no friction");
        return {text_.take(), std::move(warnings_)};
    }

  private:
    // Ids of resources are texts in Godot 4, numbers in Godot 3.
    [[nodiscard]] std::string idText(std::size_t resource) const {
        return four_ ? fmt::format("\"{}\"", resource + 1) : fmt::format(" {} ", resource + 1);
    }
    [[nodiscard]] std::string idAttribute(std::size_t resource) const {
        return four_ ? fmt::format("\"{}\"", resource + 1) : fmt::format("{}", resource + 1);
    }
    [[nodiscard]] std::string transformText(const RigidTransform& t) const {
        const mat3 m = glm::mat3_cast(t.rotation);
        std::string rows;
        for (int row = 0; row < 3; ++row)
            rows += vectorText({m[0][row], m[1][row], m[2][row]}, ", ") + ", ";
        return fmt::format("{}( {}{} )", four_ ? "Transform3D" : "Transform", rows, vectorText(t.translation, ", "));
    }

    // Unique, without the characters that paths of nodes are made of.
    void nameBones() {
        std::set<std::string> taken;
        for (std::string name : source_.character.skeleton.names) {
            std::replace_if(
                name.begin(), name.end(),
                [](unsigned char c) { return c < 0x20 || c == ':' || c == '/' || c == '"' || c == '\\'; }, '_');
            if (name.empty()) name = "bone";
            std::string unique = name;
            for (int i = 2; !taken.insert(unique).second; ++i)
                unique = fmt::format("{}_{}", name, i);
            bones_.push_back(std::move(unique));
        }
    }

    void resources() {
        text_.blank();
        text_.line("[sub_resource type=\"GDScript\" id={}]", idAttribute(0));
        std::string source;
        for (const char c : four_ ? kScriptFour : kScriptThree) {
            if (c == '"' || c == '\\') source += '\\';
            source += c;
        }
        text_.line("script/source = \"{}\"", source);
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            text_.blank();
            shapeResource(i);
        }
    }

    // All bodies' main shapes, then the others.
    struct ShapeOfBody {
        const PrimitiveShape* shape;
        std::size_t body;
        int count;  // 1: the body's main shape
        RigidTransform bodyFromShape;
    };
    void placeShapes() {
        for (std::size_t i = 0; i < profile_.bodies.size(); ++i)
            shapes_.push_back({&profile_.bodies[i].shape, i, 1, {}});
        for (std::size_t i = 0; i < profile_.bodies.size(); ++i) {
            int count = 1;
            for (const physics::AddedShape& added : profile_.bodies[i].shape.more)
                shapes_.push_back({&added, i, ++count, added.bodyFromShape});
        }
    }

    void shapeResource(std::size_t index) {
        const PrimitiveShape& shape = *shapes_[index].shape;
        const auto begin = [&](std::string_view type) {
            text_.line("[sub_resource type=\"{}{}\" id={}]", type, four_ ? "3D" : "", idAttribute(index + 1));
        };
        switch (shape.kind) {
            case PrimitiveShape::Kind::capsule:
                begin("CapsuleShape");
                text_.line("radius = {}", numberText(shape.radius));
                // From tip to tip in Godot 4, between the caps' centres in Godot 3.
                text_.line("height = {}", numberText(2.0F * (shape.halfLength + (four_ ? shape.radius : 0.0F))));
                return;
            case PrimitiveShape::Kind::sphere:
                begin("SphereShape");
                text_.line("radius = {}", numberText(shape.radius));
                return;
            case PrimitiveShape::Kind::box:
                begin("BoxShape");
                text_.line("{} = {}( {} )", four_ ? "size" : "extents", "Vector3",
                           vectorText(shape.halfExtents * (four_ ? 2.0F : 1.0F), ", "));
                return;
            case PrimitiveShape::Kind::hull:
                begin("ConvexPolygonShape");
                text_.line("points = {}( {} )", four_ ? "PackedVector3Array" : "PoolVector3Array",
                           pointsText(*shape.hull, ", "));
                text_.line("margin = 0.002");  // which Bullet adds around it; 4 cm if nothing is said
                return;
        }
    }

    [[nodiscard]] std::string exceptionList() const {
        std::vector<std::pair<int, int>> pairs = profile_.filteredPairs;
        for (const ConstraintProfile& c : profile_.constraints)
            pairs.emplace_back(c.parent, c.child);
        std::string list;
        for (const auto& [a, b] : pairs) {
            list +=
                fmt::format("{}\"{}\", \"{}\"", list.empty() ? "" : ", ", bodyName(profile_, a), bodyName(profile_, b));
        }
        return list;
    }

    // A bone's parent is the base of its joint in the rig, not the joint's parent in the file. So the nearest body
    // above a body is its parent even where the file hangs a foot on an IK root.
    void skeleton() {
        text_.blank();
        text_.line("[node name=\"{}\" type=\"{}\" parent=\".\"]", skeletonName(), skeletonName());
        text_.line("transform = {}", transformText(standingFromModel(source_)));
        std::vector<int> place(bones_.size(), -1);
        int index = 0;
        for (const int joint : source_.rig.order) {
            const physics::Rig::Joint& bone = source_.rig.joints[joint];
            place[joint] = index;
            text_.line("bones/{}/name = {}", index, quotedText(bones_[joint]));
            text_.line("bones/{}/parent = {}", index, bone.base < 0 ? -1 : place[bone.base]);
            text_.line("bones/{}/rest = {}", index, transformText(bone.baseFromJoint));
            text_.line("bones/{}/enabled = true", index);
            if (four_) {
                text_.line("bones/{}/position = Vector3( {} )", index,
                           vectorText(bone.baseFromJoint.translation, ", "));
                text_.line("bones/{}/rotation = Quaternion( {} )", index,
                           quaternionTextXyzw(bone.baseFromJoint.rotation, ", "));
            }
            ++index;
        }
        if (!four_) return;
        text_.blank();
        text_.line("[node name=\"PhysicalBoneSimulator3D\" type=\"PhysicalBoneSimulator3D\" parent=\"Skeleton3D\"]");
    }
    [[nodiscard]] std::string_view skeletonName() const { return four_ ? "Skeleton3D" : "Skeleton"; }
    [[nodiscard]] std::string_view bodiesPath() const {
        return four_ ? "Skeleton3D/PhysicalBoneSimulator3D" : "Skeleton";
    }

    void body(int index) {
        const BodyProfile& b = profile_.bodies[index];
        text_.blank();
        text_.line("[node name=\"{}\" type=\"{}\" parent=\"{}\"]", bodyName(profile_, index),
                   four_ ? "PhysicalBone3D" : "PhysicalBone", bodiesPath());
        text_.line("transform = {}", transformText(source_.rig.bindModelFromBody[index]));
        if (index == 0) {
            text_.line("joint_type = 0");
        } else {
            joint(profile_.constraints[index - 1]);
        }
        text_.line("body_offset = {}", transformText(b.jointFromBody));
        text_.line("mass = {}", numberText(b.massKg));
        text_.line("friction = {}", numberText(kContactFriction));
        text_.line("bone_name = {}", quotedText(bones_[source_.rig.jointOfBody[index]]));
        for (std::size_t i = 0; i < shapes_.size(); ++i)
            if (shapes_[i].body == static_cast<std::size_t>(index)) shapeNode(i);
    }

    void shapeNode(std::size_t index) {
        const ShapeOfBody& one = shapes_[index];
        text_.blank();
        text_.line("[node name=\"Shape{}\" type=\"CollisionShape{}\" parent=\"{}/{}\"]",
                   one.count == 1 ? "" : std::to_string(one.count), four_ ? "3D" : "", bodiesPath(),
                   bodyName(profile_, static_cast<int>(one.body)));
        // Godot 3's capsule lies along z.
        const bool turned = !four_ && one.shape->kind == PrimitiveShape::Kind::capsule;
        const RigidTransform shapeFromNode{turned ? glm::angleAxis(-0.5F * kPi, vec3(1, 0, 0)) : quat(1, 0, 0, 0),
                                           vec3(0)};
        if (turned || one.count > 1) text_.line("transform = {}", transformText(one.bodyFromShape * shapeFromNode));
        text_.line("shape = SubResource({})", idText(index + 1));
    }

    // Both frames of a joint are one in the bind pose there: limits are told from it. Angles run clockwise.
    void joint(const ConstraintProfile& c) {
        const JointRange range =
            physics::jointRange(c, {source_.rig.bindModelFromBody[c.parent], source_.rig.bindModelFromBody[c.child]});
        const bool hinge = c.kind == ConstraintProfile::Kind::hinge;
        text_.line("joint_type = {}", hinge ? kHingeJoint : kSixDofJoint);
        text_.line("joint_offset = {}", transformText(jointFrame(c)));
        if (hinge) {
            text_.line("joint_constraints/angular_limit_enabled = true");
            text_.line("joint_constraints/angular_limit_upper = {}", numberText(degrees(-range.flexion.low)));
            text_.line("joint_constraints/angular_limit_lower = {}", numberText(degrees(-range.flexion.high)));
            return;
        }
        const std::array<AngleSpan, 3> spans{range.twist, range.side, range.flexion};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const char name = "xyz"[axis];
            text_.line("joint_constraints/{}/angular_limit_enabled = true", name);
            text_.line("joint_constraints/{}/angular_limit_upper = {}", name, numberText(degrees(-spans[axis].low)));
            text_.line("joint_constraints/{}/angular_limit_lower = {}", name, numberText(degrees(-spans[axis].high)));
        }
        warnings_.push_back(fmt::format(
            "{}: the elliptic cone is a range for each of three angles from the bind pose, {:.0f} by {:.0f} degrees",
            bodyName(profile_, c.child), degrees(range.side.high - range.side.low),
            degrees(range.flexion.high - range.flexion.low)));
    }

    // In the child's body. The origin is the bone's, which is also ours but where the fit moved the anchor.
    RigidTransform jointFrame(const ConstraintProfile& c) {
        const vec3 boneOrigin = inverse(profile_.bodies[c.child].jointFromBody).translation;
        const float off = glm::distance(boneOrigin, c.childFromFrame.translation);
        if (off > 1e-3F * profile_.heightM) {
            warnings_.push_back(fmt::format("{}: Godot puts the joint on the bone's origin, {:.0f} mm from the anchor",
                                            bodyName(profile_, c.child), 1e3F * off));
        }
        return {c.childFromFrame.rotation, boneOrigin};
    }

    const ExportSource& source_;
    const RagdollProfile& profile_;
    bool four_;
    std::vector<std::string> bones_;
    std::vector<ShapeOfBody> shapes_;
    TextBuilder text_;
    std::vector<std::string> warnings_;
};

}  // namespace

Exported writeGodot(const ExportSource& source, GodotVersion version) {
    return GodotWriter(source, version).write();
}

}  // namespace lutka::exporting
