#include "export/write_usd.hpp"

#include "export/doll_layout.hpp"
#include "export/text_builder.hpp"

namespace lutka::exporting {
namespace {

using physics::BodyProfile;
using physics::ConstraintProfile;
using physics::PrimitiveShape;
using physics::RagdollProfile;

class UsdWriter {
  public:
    explicit UsdWriter(const ExportSource& source) : source_(source), profile_(source.profile) {}

    Exported write() {
        text_.line("#usda 1.0");
        text_.line("(");
        text_.line("    defaultPrim = \"Ragdoll\"");
        text_.line("    kilogramsPerUnit = 1");
        text_.line("    metersPerUnit = 1");
        text_.line("    upAxis = \"Y\"");
        text_.line(")");
        text_.blank();
        begin("def Xform \"Ragdoll\"", "\"MaterialBindingAPI\"");
        text_.line("rel material:binding:physics = </Ragdoll/contact_material>");  // all shapes below have it
        for (std::size_t i = 0; i < profile_.bodies.size(); ++i)
            body(static_cast<int>(i));
        for (const ConstraintProfile& constraint : profile_.constraints)
            joint(constraint);
        material();
        end();
        return {
            text_.take(),
            {"USD's own library has not checked this file", "a cone is three limited angles; joints have no friction"}};
    }

  private:
    // Laid out as USD's own tools do: some readers (three.js) go line by line and find nothing in shorter forms.
    void begin(std::string_view what, std::string_view schemas = {}) {
        text_.line("{}{}", what, schemas.empty() ? "" : " (");
        if (!schemas.empty()) {
            text_.line("    prepend apiSchemas = [{}]", schemas);
            text_.line(")");
        }
        text_.line("{{");
        text_.indent();
        text_.indent();
    }
    void end() {
        text_.outdent();
        text_.outdent();
        text_.line("}}");
    }
    [[nodiscard]] std::string path(int body) const { return "</Ragdoll/" + bodyName(profile_, body) + ">"; }

    void body(int index) {
        const BodyProfile& b = profile_.bodies[index];
        const RigidTransform world = standingFromModel(source_) * source_.rig.bindModelFromBody[index];
        const std::string others = filtered(index);
        begin(fmt::format("def Xform \"{}\"", bodyName(profile_, index)),
              fmt::format("\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"{}",
                          others.empty() ? "" : ", \"PhysicsFilteredPairsAPI\""));
        text_.line("double3 xformOp:translate = ({})", vectorText(world.translation, ", "));
        text_.line("quatf xformOp:orient = ({})", quaternionTextWxyz(world.rotation, ", "));
        text_.line("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
        text_.line("float physics:mass = {}", numberText(b.massKg));
        text_.line("point3f physics:centerOfMass = (0, 0, 0)");
        text_.line("float3 physics:diagonalInertia = ({})", vectorText(b.inertia, ", "));
        text_.line("quatf physics:principalAxes = (1, 0, 0, 0)");
        if (!others.empty()) text_.line("rel physics:filteredPairs = [{}]", others);
        int count = 0;
        visitShapes(b.shape, [&](const PrimitiveShape& s, const RigidTransform& bodyFromShape) {
            shape(s, ++count, bodyFromShape);
        });
        end();
    }

    // How two materials combine is PhysX's own schema: UsdPhysics says nothing of it.
    void material() {
        begin("def Material \"contact_material\"", "\"PhysicsMaterialAPI\", \"PhysxMaterialAPI\"");
        text_.line("float physics:staticFriction = {}", numberText(physics::kBodyFriction));
        text_.line("float physics:dynamicFriction = {}", numberText(physics::kBodyFriction));
        text_.line("float physics:restitution = 0");
        text_.line("uniform token physxMaterial:frictionCombineMode = \"multiply\"");
        end();
    }

    // Of each pair, one of the two names the other.
    [[nodiscard]] std::string filtered(int body) const {
        std::string others;
        for (const auto& [first, second] : profile_.filteredPairs)
            if (first == body) others += (others.empty() ? "" : ", ") + path(second);
        return others;
    }

    // The first one lies at the body's origin.
    void shape(const PrimitiveShape& s, int count, const RigidTransform& bodyFromShape) {
        const bool isMain = count == 1;
        const auto beginShape = [&](std::string_view type) {
            begin(fmt::format("def {} \"shape{}\"", type, isMain ? "" : std::to_string(count)),
                  s.kind == PrimitiveShape::Kind::hull ? "\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\""
                                                       : "\"PhysicsCollisionAPI\"");
            if (isMain) return;
            text_.line("double3 xformOp:translate = ({})", vectorText(bodyFromShape.translation, ", "));
            text_.line("quatf xformOp:orient = ({})", quaternionTextWxyz(bodyFromShape.rotation, ", "));
        };
        const auto order = [&](std::string_view last) {
            const std::string_view place = isMain ? "" : "\"xformOp:translate\", \"xformOp:orient\"";
            if (place.empty() && last.empty()) return;
            text_.line("uniform token[] xformOpOrder = [{}{}{}]", place, place.empty() || last.empty() ? "" : ", ",
                       last);
        };
        switch (s.kind) {
            case PrimitiveShape::Kind::capsule:
                beginShape("Capsule");
                text_.line("uniform token axis = \"Y\"");
                text_.line("double height = {}", numberText(2.0F * s.halfLength));  // without the caps
                text_.line("double radius = {}", numberText(s.radius));
                order("");
                break;
            case PrimitiveShape::Kind::sphere:
                beginShape("Sphere");
                text_.line("double radius = {}", numberText(s.radius));
                order("");
                break;
            case PrimitiveShape::Kind::box:
                beginShape("Cube");
                text_.line("double size = 2");
                text_.line("float3 xformOp:scale = ({})", vectorText(s.halfExtents, ", "));
                order("\"xformOp:scale\"");
                break;
            case PrimitiveShape::Kind::hull:
                beginShape("Mesh");
                mesh(*s.hull);
                order("");
                break;
        }
        end();
    }

    void mesh(const physics::ConvexHull& hull) {
        std::string points;
        std::string counts;
        std::string corners;
        const auto append = [](std::string& list, const std::string& one) { list += (list.empty() ? "" : ", ") + one; };
        for (const vec3& point : hull.points())
            append(points, fmt::format("({})", vectorText(point, ", ")));
        for (const physics::ConvexHull::Face& face : hull.faces()) {
            append(counts, std::to_string(face.count));
            for (const int corner : hull.cornersOf(face))
                append(corners, std::to_string(corner));
        }
        text_.line("uniform token physics:approximation = \"convexHull\"");
        text_.line("uniform token subdivisionScheme = \"none\"");
        text_.line("point3f[] points = [{}]", points);
        text_.line("int[] faceVertexCounts = [{}]", counts);
        text_.line("int[] faceVertexIndices = [{}]", corners);
    }

    void range(const char* axis, float low, float high) {
        text_.line("float limit:{}:physics:low = {}", axis, numberText(low));
        text_.line("float limit:{}:physics:high = {}", axis, numberText(high));
    }

    void joint(const ConstraintProfile& c) {
        const bool hinge = c.kind == ConstraintProfile::Kind::hinge;
        const std::string name = bodyName(profile_, c.child) + "_joint";
        if (hinge) {
            begin(fmt::format("def PhysicsRevoluteJoint \"{}\"", name));
        } else {
            std::string limits;
            for (const char* axis : {"transX", "transY", "transZ", "rotX", "rotY", "rotZ"})
                limits += fmt::format("{}\"PhysicsLimitAPI:{}\"", limits.empty() ? "" : ", ", axis);
            begin(fmt::format("def PhysicsJoint \"{}\"", name), limits);
        }
        text_.line("rel physics:body0 = {}", path(c.parent));
        text_.line("rel physics:body1 = {}", path(c.child));
        text_.line("point3f physics:localPos0 = ({})", vectorText(c.parentFromFrame.translation, ", "));
        text_.line("quatf physics:localRot0 = ({})", quaternionTextWxyz(c.parentFromFrame.rotation, ", "));
        text_.line("point3f physics:localPos1 = ({})", vectorText(c.childFromFrame.translation, ", "));
        text_.line("quatf physics:localRot1 = ({})", quaternionTextWxyz(c.childFromFrame.rotation, ", "));
        if (hinge) {
            text_.line("uniform token physics:axis = \"Z\"");
            text_.line("float physics:lowerLimit = {}", numberText(degrees(c.hinge.lower)));
            text_.line("float physics:upperLimit = {}", numberText(degrees(c.hinge.upper)));
        } else {
            for (const char* axis : {"transX", "transY", "transZ"})
                range(axis, 1, -1);  // low above high: locked
            range("rotX", -degrees(c.cone.twist), degrees(c.cone.twist));
            range("rotY", -degrees(c.cone.swingY), degrees(c.cone.swingY));
            range("rotZ", -degrees(c.cone.swingZ), degrees(c.cone.swingZ));
        }
        end();
    }

    const ExportSource& source_;
    const RagdollProfile& profile_;
    TextBuilder text_;
};

}  // namespace

Exported writeUsd(const ExportSource& source) {
    return UsdWriter(source).write();
}

}  // namespace lutka::exporting
