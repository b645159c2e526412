#include "physics/bullet/warm_solver.hpp"

#include <algorithm>

#include "physics/bullet/ragdoll_joint.hpp"

namespace lutka::physics {
namespace {

// Bullet keeps a row's constraint in this member, contacts their point.
RagdollJoint* jointOf(const btSolverConstraint& row) {
    auto* constraint = static_cast<btTypedConstraint*>(row.m_originalContactPoint);
    return constraint->getUserConstraintType() == RagdollJoint::kUserType ? static_cast<RagdollJoint*>(constraint)
                                                                          : nullptr;
}

// Calls visit(row, joint, index of the row within its joint) for the rows of all ragdoll joints.
template <class Visit>
void forEachJointRow(btConstraintArray& rows, const Visit& visit) {
    void* last = nullptr;
    int index = 0;
    for (int i = 0; i < rows.size(); ++i) {
        index = rows[i].m_originalContactPoint == last ? index + 1 : 0;
        last = rows[i].m_originalContactPoint;
        if (RagdollJoint* joint = jointOf(rows[i])) visit(rows[i], *joint, index);
    }
}

}  // namespace

void WarmSolver::convertJoints(btTypedConstraint** constraints, int count, const btContactSolverInfo& info) {
    btSequentialImpulseConstraintSolver::convertJoints(constraints, count, info);
    if (!tuning_.warmStart) return;
    forEachJointRow(m_tmpSolverNonContactConstraintPool, [&](btSolverConstraint& row, RagdollJoint& joint, int index) {
        row.m_appliedImpulse = std::clamp(joint.storedImpulse(index), row.m_lowerLimit, row.m_upperLimit);
        btSolverBody& a = m_tmpSolverBodyPool[row.m_solverBodyIdA];
        btSolverBody& b = m_tmpSolverBodyPool[row.m_solverBodyIdB];
        a.internalApplyImpulse(row.m_contactNormal1 * a.internalGetInvMass(), row.m_angularComponentA,
                               row.m_appliedImpulse);
        b.internalApplyImpulse(row.m_contactNormal2 * b.internalGetInvMass(), row.m_angularComponentB,
                               row.m_appliedImpulse);
    });
}

void WarmSolver::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
    btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
    for (int i = 0; i < m_tmpSolverContactConstraintPool.size(); ++i) {
        btSolverConstraint& row = m_tmpSolverContactConstraintPool[i];
        row.m_rhsPenetration = std::min(row.m_rhsPenetration, tuning_.maxPushSpeed * row.m_jacDiagABInv);
    }
}

btScalar WarmSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                                   const btContactSolverInfo& info) {
    forEachJointRow(m_tmpSolverNonContactConstraintPool, [](btSolverConstraint& row, RagdollJoint& joint, int index) {
        joint.storeImpulse(index, row.m_appliedImpulse);
    });
    forEachJointRow(m_tmpSolverNonContactConstraintPool, [](btSolverConstraint&, RagdollJoint& joint, int index) {
        if (index == 0) joint.finishStoring();
    });
    return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, count, info);
}

}  // namespace lutka::physics
