#include "physics/bullet/analytic_collision.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <new>

#include "physics/bullet/contact_impulses.hpp"
#include "physics/bullet/convert.hpp"
#include "physics/bullet/geometry_cache.hpp"
#include "physics/collision/contacts.hpp"

namespace lutka::physics {
namespace {

// Features of the pairs of a body's shapes are kept apart by these.
constexpr int kPartStride = 1 << 20;
constexpr int kParts = 1 + static_cast<int>(BodyShape::kMostAdded);

bool isPart(const btCollisionObjectWrapper& wrapper) {
    return wrapper.getCollisionShape() != wrapper.getCollisionObject()->getCollisionShape();
}
// 0 for what is whole, and for a body's main shape.
int numberOf(const btCollisionObjectWrapper& wrapper) {
    return isPart(wrapper) ? std::max(wrapper.m_index, 0) : 0;
}

CollisionGeometry geometryOfPart(const btCollisionObjectWrapper& wrapper, const GeometryCache& geometries) {
    if (!isPart(wrapper)) return geometries.of(*wrapper.getCollisionObject());
    CollisionGeometry geometry;
    float reach = 0.0F;
    [[maybe_unused]] const bool known = describeShape(*wrapper.getCollisionShape(), geometry, reach);
    geometry.worldFromShape = fromBullet(wrapper.getWorldTransform());
    return geometry;
}

// Before each step Bullet's compound algorithms place the old points anew by these, and drop what has drifted off.
void setLocalPoints(btPersistentManifold& manifold) {
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
        btManifoldPoint& point = manifold.getContactPoint(i);
        point.m_localPointA = manifold.getBody0()->getWorldTransform().invXform(point.m_positionWorldOnA);
        point.m_localPointB = manifold.getBody1()->getWorldTransform().invXform(point.m_positionWorldOnB);
    }
}

class AnalyticCollision final : public btCollisionAlgorithm {
  public:
    AnalyticCollision(const btCollisionAlgorithmConstructionInfo& info, float margin, const GeometryCache& geometries)
        : btCollisionAlgorithm(info), margin_(margin), geometries_(geometries) {}
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
        for (btPersistentManifold* manifold : manifolds_)
            if (manifold != nullptr) manifolds.push_back(manifold);
    }

    /// Brings the manifolds up to date with where the two are.
    void collide(const btCollisionObject& a, const btCollisionObject& b);
    /// The same of a part of a body of several shapes, which Bullet's compound algorithms hand over one by one.
    void collideParts(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b);
    /// The two are too far apart for any contact.
    void release() { keep(0, nullptr, nullptr); }

  private:
    // Bullet's manifolds hold four points.
    static constexpr int kPoints = MANIFOLD_CACHE_SIZE;
    static constexpr int kManifolds = ContactList::kMax / kPoints;

    // Has manifolds for `count` points and gives back what is not needed.
    void keep(int count, const btCollisionObject* a, const btCollisionObject* b);
    void fill(const ContactList& list);

    float margin_;
    const GeometryCache& geometries_;
    std::array<btPersistentManifold*, kManifolds> manifolds_{};  // the dispatcher's
};

void AnalyticCollision::keep(int count, const btCollisionObject* a, const btCollisionObject* b) {
    for (int i = 0; i < kManifolds; ++i) {
        btPersistentManifold*& manifold = manifolds_[i];
        if (i * kPoints >= count) {
            if (manifold != nullptr) m_dispatcher->releaseManifold(manifold);
            manifold = nullptr;
        } else if (manifold == nullptr) {
            manifold = m_dispatcher->getNewManifold(a, b);
        }
    }
}

// New points in the place of the old ones; a point of the same feature goes on with the old one's impulses. Points are
// written where they lie, and only what is read of them: they are large, and there are many.
void AnalyticCollision::fill(const ContactList& list) {
    std::array<ContactImpulses, ContactList::kMax> old;
    int oldCount = 0;
    for (btPersistentManifold* manifold : manifolds_) {
        for (int i = 0; manifold != nullptr && i < manifold->getNumContacts(); ++i)
            old[oldCount++] = impulsesOf(manifold->getContactPoint(i));
    }
    const btCollisionObject& a = *manifolds_[0]->getBody0();
    const btCollisionObject& b = *manifolds_[0]->getBody1();
    const btScalar friction = btManifoldResult::calculateCombinedFriction(&a, &b);
    const btScalar restitution = btManifoldResult::calculateCombinedRestitution(&a, &b);
    for (int i = 0; i < list.count; ++i) {
        const SurfaceContact& contact = list.contacts[i];
        btPersistentManifold& manifold = *manifolds_[i / kPoints];
        manifold.setNumContacts(i % kPoints + 1);
        btManifoldPoint& point = manifold.getContactPoint(i % kPoints);
        point.m_normalWorldOnB = toBullet(contact.normal);
        point.m_positionWorldOnB = toBullet(contact.position);
        point.m_positionWorldOnA = point.m_positionWorldOnB + contact.distance * point.m_normalWorldOnB;
        point.m_distance1 = contact.distance;
        point.m_index0 = contact.feature;
        point.m_combinedFriction = friction;
        point.m_combinedRestitution = restitution;
        ContactImpulses impulses;
        for (int k = 0; k < oldCount; ++k) {
            if (old[k].feature != contact.feature) continue;
            impulses = old[k];
            ++impulses.age;
        }
        setImpulses(point, impulses);
    }
}

void AnalyticCollision::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                         const btDispatcherInfo& /*info*/, btManifoldResult* result) {
    if (isPart(*a) || isPart(*b))
        collideParts(*a, *b);
    else
        collide(*a->getCollisionObject(), *b->getCollisionObject());
    result->setPersistentManifold(manifolds_[0]);
}

void AnalyticCollision::collideParts(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b) {
    const btCollisionObject& objectA = *a.getCollisionObject();
    const btCollisionObject& objectB = *b.getCollisionObject();
    const float margin = margin_ + geometries_.aheadOf(objectA) + geometries_.aheadOf(objectB);
    ContactList list = findContacts(geometryOfPart(a, geometries_), geometryOfPart(b, geometries_), margin);
    for (int i = 0; i < list.count; ++i)
        list.contacts[i].feature += kPartStride * (numberOf(a) + kParts * numberOf(b));
    keep(list.count, &objectA, &objectB);
    if (list.count == 0) return;
    fill(list);
    for (btPersistentManifold* manifold : manifolds_)
        if (manifold != nullptr) setLocalPoints(*manifold);
}

void AnalyticCollision::collide(const btCollisionObject& a, const btCollisionObject& b) {
    const float margin = margin_ + geometries_.aheadOf(a) + geometries_.aheadOf(b);
    const ContactList list = findContacts(geometries_.of(a), geometries_.of(b), margin);
    keep(list.count, &a, &b);
    if (list.count > 0) fill(list);
}

}  // namespace

btCollisionAlgorithm* AnalyticCollisionFactory::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                                         const btCollisionObjectWrapper* /*a*/,
                                                                         const btCollisionObjectWrapper* /*b*/) {
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(AnalyticCollision));
    return new (memory) AnalyticCollision(info, margin_, geometries_);
}

bool AnalyticCollisionFactory::farApart(const btCollisionObject& a, const btCollisionObject& b) const {
    const CollisionGeometry& first = geometries_.of(a);
    const CollisionGeometry& second = geometries_.of(b);
    using Kind = ShapeKind;
    if (first.kind == Kind::mesh || second.kind == Kind::mesh) return false;
    if (first.kind == Kind::plane) return farApart(b, a);
    const float margin = margin_ + geometries_.aheadOf(a) + geometries_.aheadOf(b);
    const vec3 offset = first.worldFromShape.translation - second.worldFromShape.translation;
    if (second.kind == Kind::plane) {
        const vec3 normal = second.worldFromShape.rotation * vec3(0, 1, 0);
        return glm::dot(offset, normal) > geometries_.reachOf(a) + margin;
    }
    const float reach = geometries_.reachOf(a) + geometries_.reachOf(b) + margin;
    return glm::dot(offset, offset) > reach * reach;
}

void AnalyticCollisionFactory::collide(btBroadphasePair& pair, btCollisionDispatcher& dispatcher) {
    auto& a = *static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject);
    auto& b = *static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
    auto* algorithm = static_cast<AnalyticCollision*>(pair.m_algorithm);
    if (farApart(a, b)) {
        if (algorithm != nullptr) algorithm->release();
        return;
    }
    if (algorithm == nullptr) {
        const btCollisionObjectWrapper wrapperA(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1, -1);
        const btCollisionObjectWrapper wrapperB(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
        pair.m_algorithm = dispatcher.findAlgorithm(&wrapperA, &wrapperB, nullptr, BT_CONTACT_POINT_ALGORITHMS);
        algorithm = static_cast<AnalyticCollision*>(pair.m_algorithm);
    }
    algorithm->collide(a, b);
}

bool AnalyticCollisionFactory::handles(const btCollisionObject& a, const btCollisionObject& b) const {
    if (!geometries_.knows(a) || !geometries_.knows(b)) return false;
    using Kind = ShapeKind;
    const Kind first = geometries_.of(a).kind;
    const Kind second = geometries_.of(b).kind;
    const auto isAngular = [](Kind kind) { return kind == Kind::box || kind == Kind::hull; };
    if (first == second || (isAngular(first) && isAngular(second))) return first == Kind::capsule;
    return first == Kind::capsule || second == Kind::capsule || (first != Kind::mesh && second != Kind::mesh);
}

void AnalyticCollisionFactory::registerWith(btCollisionDispatcher& dispatcher) {
    // Boxes and hulls on meshes are left to Bullet, which sees edges against edges; so are they on each other.
    for (const int round : {CAPSULE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE}) {
        dispatcher.registerCollisionCreateFunc(round, TRIANGLE_MESH_SHAPE_PROXYTYPE, this);
        dispatcher.registerCollisionCreateFunc(TRIANGLE_MESH_SHAPE_PROXYTYPE, round, this);
    }
    const std::array<int, 5> types{CAPSULE_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE,
                                   CONVEX_HULL_SHAPE_PROXYTYPE, STATIC_PLANE_PROXYTYPE};
    const auto isAngular = [](int type) { return type == BOX_SHAPE_PROXYTYPE || type == CONVEX_HULL_SHAPE_PROXYTYPE; };
    for (const int a : types) {
        for (const int b : types) {
            if (isAngular(a) && isAngular(b)) continue;
            if (a == b && a == STATIC_PLANE_PROXYTYPE) continue;
            dispatcher.registerCollisionCreateFunc(a, b, this);
        }
    }
}

}  // namespace lutka::physics
