#include "physics/bullet/analytic_collision.hpp"

#include <btBulletDynamicsCommon.h>

#include <array>
#include <new>

#include "physics/bullet/convert.hpp"
#include "physics/contacts.hpp"

namespace lutka::physics {
namespace {

CollisionGeometry geometryOf(const btCollisionObjectWrapper& wrapper) {
    const btCollisionShape& shape = *wrapper.getCollisionShape();
    CollisionGeometry geometry;
    geometry.worldFromShape = fromBullet(wrapper.getWorldTransform());
    switch (shape.getShapeType()) {
        case CAPSULE_SHAPE_PROXYTYPE: {
            const auto& capsule = static_cast<const btCapsuleShape&>(shape);
            geometry.radius = capsule.getRadius();
            geometry.halfLength = capsule.getHalfHeight();
            break;
        }
        case SPHERE_SHAPE_PROXYTYPE:
            geometry.radius = static_cast<const btSphereShape&>(shape).getRadius();
            break;
        case BOX_SHAPE_PROXYTYPE:
            geometry.kind = CollisionGeometry::Kind::box;
            geometry.halfExtents = fromBullet(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin());
            break;
        default: {
            const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
            geometry.kind = CollisionGeometry::Kind::plane;
            const quat turn = rotationBetween({0, 1, 0}, fromBullet(plane.getPlaneNormal()));
            geometry.worldFromShape =
                geometry.worldFromShape * RigidTransform{turn, turn * vec3(0, plane.getPlaneConstant(), 0)};
        }
    }
    return geometry;
}

class AnalyticCollision final : public btCollisionAlgorithm {
  public:
    AnalyticCollision(const btCollisionAlgorithmConstructionInfo& info, float margin)
        : btCollisionAlgorithm(info), margin_(margin) {}
    ~AnalyticCollision() override { release(); }
    AnalyticCollision(const AnalyticCollision&) = delete;
    AnalyticCollision& operator=(const AnalyticCollision&) = delete;

    void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                          const btDispatcherInfo& info, btManifoldResult* result) override;
    btScalar calculateTimeOfImpact(btCollisionObject* /*a*/, btCollisionObject* /*b*/, const btDispatcherInfo& /*info*/,
                                   btManifoldResult* /*result*/) override {
        return 1.0F;
    }
    void getAllContactManifolds(btManifoldArray& manifolds) override {
        if (manifold_ != nullptr) manifolds.push_back(manifold_);
    }

  private:
    void release() {
        if (manifold_ != nullptr) m_dispatcher->releaseManifold(manifold_);
        manifold_ = nullptr;
    }
    void fill(const ContactList& list, const btTransform& worldFromA, const btTransform& worldFromB);

    float margin_;
    btPersistentManifold* manifold_ = nullptr;  // the dispatcher's
};

// New points in the place of the old ones; a point of the same feature goes on with the old one's impulses.
void AnalyticCollision::fill(const ContactList& list, const btTransform& worldFromA, const btTransform& worldFromB) {
    std::array<btManifoldPoint, ContactList::kMax> old;
    const int oldCount = manifold_->getNumContacts();
    for (int i = 0; i < oldCount; ++i)
        old[i] = manifold_->getContactPoint(i);
    const btScalar friction = btManifoldResult::calculateCombinedFriction(manifold_->getBody0(), manifold_->getBody1());
    const btScalar restitution =
        btManifoldResult::calculateCombinedRestitution(manifold_->getBody0(), manifold_->getBody1());
    manifold_->setNumContacts(list.count);
    for (int i = 0; i < list.count; ++i) {
        const SurfaceContact& contact = list.contacts[i];
        const btVector3 onB = toBullet(contact.position);
        const btVector3 normal = toBullet(contact.normal);
        const btVector3 onA = onB + contact.distance * normal;
        btManifoldPoint point(worldFromA.invXform(onA), worldFromB.invXform(onB), normal, contact.distance);
        point.m_positionWorldOnA = onA;
        point.m_positionWorldOnB = onB;
        point.m_index0 = contact.feature;
        point.m_combinedFriction = friction;
        point.m_combinedRestitution = restitution;
        btPlaneSpace1(normal, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2);
        for (int k = 0; k < oldCount; ++k) {
            if (old[k].m_index0 != contact.feature) continue;
            point.m_appliedImpulse = old[k].m_appliedImpulse;
            point.m_appliedImpulseLateral1 = old[k].m_appliedImpulseLateral1;
            point.m_appliedImpulseLateral2 = old[k].m_appliedImpulseLateral2;
            point.m_lifeTime = old[k].m_lifeTime + 1;
        }
        manifold_->getContactPoint(i) = point;
    }
}

void AnalyticCollision::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                         const btDispatcherInfo& /*info*/, btManifoldResult* result) {
    const ContactList list = findContacts(geometryOf(*a), geometryOf(*b), margin_);
    if (list.count == 0) {
        release();
        result->setPersistentManifold(nullptr);
        return;
    }
    if (manifold_ == nullptr)
        manifold_ = m_dispatcher->getNewManifold(a->getCollisionObject(), b->getCollisionObject());
    fill(list, a->getWorldTransform(), b->getWorldTransform());
    result->setPersistentManifold(manifold_);
}

}  // namespace

btCollisionAlgorithm* AnalyticCollisionFactory::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                         const btCollisionObjectWrapper* /*a*/,
                                                                         const btCollisionObjectWrapper* /*b*/) {
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(AnalyticCollision));
    return new (memory) AnalyticCollision(info, margin_);
}

void AnalyticCollisionFactory::registerWith(btCollisionDispatcher& dispatcher) {
    const std::array<int, 4> types{CAPSULE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE,
                                   STATIC_PLANE_PROXYTYPE};
    for (const int a : types) {
        for (const int b : types) {
            if (a == b && (a == BOX_SHAPE_PROXYTYPE || a == STATIC_PLANE_PROXYTYPE)) continue;
            dispatcher.registerCollisionCreateFunc(a, b, this);
        }
    }
}

}  // namespace lutka::physics
