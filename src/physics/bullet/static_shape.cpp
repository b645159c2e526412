#include "physics/bullet/static_shape.hpp"

#include "physics/bullet/convert.hpp"

namespace lutka::physics {
namespace {

// A mesh's shape with Bullet's view of its triangles.
class MeshShape final : private std::unique_ptr<btTriangleIndexVertexArray>, public btBvhTriangleMeshShape {
  public:
    explicit MeshShape(std::shared_ptr<const TriangleMesh> mesh)
        : std::unique_ptr<btTriangleIndexVertexArray>(viewOf(*mesh)),
          btBvhTriangleMeshShape(get(), true),
          mesh_(std::move(mesh)) {
        setUserPointer(const_cast<TriangleMesh*>(mesh_.get()));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    }

  private:
    static std::unique_ptr<btTriangleIndexVertexArray> viewOf(const TriangleMesh& mesh) {
        btIndexedMesh part;
        part.m_numTriangles = static_cast<int>(mesh.triangles().size());
        part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh.triangles().data());
        part.m_triangleIndexStride = sizeof(TriangleMesh::Triangle);
        part.m_numVertices = static_cast<int>(mesh.vertices().size());
        part.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh.vertices().data());
        part.m_vertexStride = sizeof(vec3);
        auto view = std::make_unique<btTriangleIndexVertexArray>();
        view->addIndexedMesh(part);
        return view;
    }

    std::shared_ptr<const TriangleMesh> mesh_;
};

}  // namespace

BodyInWorld makeStaticShape(const StaticShape& shape) {
    BodyInWorld made;
    switch (shape.kind) {
        case StaticShape::Kind::plane:
            made.shape = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), 0.0F);
            break;
        case StaticShape::Kind::box:
            made.shape = std::make_unique<btBoxShape>(toBullet(shape.halfExtents));
            break;
        case StaticShape::Kind::sphere:
            made.shape = std::make_unique<btSphereShape>(shape.radius);
            break;
        case StaticShape::Kind::capsule:
            made.shape = std::make_unique<btCapsuleShape>(shape.radius, 2.0F * shape.halfLength);
            break;
        case StaticShape::Kind::hull:  // World refuses it
            break;
        case StaticShape::Kind::mesh:
            made.shape = std::make_unique<MeshShape>(shape.mesh);
            break;
    }
    return made;
}

}  // namespace lutka::physics
