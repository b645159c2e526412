#include "random_chain.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/pose.hpp"

namespace lutka::test {

using namespace animation;

vec3 randomDirection(Random& random) {
    for (;;) {
        const vec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const float length = glm::length(v);
        if (length > 0.1F && length < 1.0F) return v / length;
    }
}

quat randomTurn(Random& random, float most) {
    return glm::angleAxis(random.uniform(-most, most), randomDirection(random));
}

RandomChain makeRandomChain(Random& random, int joints, float mostBend) {
    RandomChain chain;
    const auto add = [&](const RigidTransform& local) {
        chain.skeleton.names.push_back("joint");
        chain.skeleton.parents.push_back(chain.skeleton.jointCount() - 1);
        chain.pose.push_back(local);
        chain.skeleton.nodeParentFromJoint.push_back(local);
        chain.skeleton.skinWeight.push_back(1.0F);
    };
    add({randomTurn(random, kPi), randomDirection(random)});
    // The bones go roughly one way; how the joints' frames lie to them says nothing.
    vec3 model = randomDirection(random);
    quat modelFromParent = chain.pose[0].rotation;
    for (int i = 0; i < joints; ++i) {
        model = randomTurn(random, mostBend) * model;
        const quat frame = randomTurn(random, kPi);
        const float length = i == 0 ? 0.1F : random.uniform(0.1F, 0.5F);
        add({glm::conjugate(modelFromParent) * frame, glm::conjugate(modelFromParent) * model * length});
        modelFromParent = frame;
        chain.joints.push_back(i + 1);
    }
    chain.skeleton.bindModelFromJoint.resize(chain.pose.size());
    localToModel(chain.skeleton, chain.pose, chain.skeleton.bindModelFromJoint);
    return chain;
}

vec3 RandomChain::at(int index) const {
    return modelFrameOf(skeleton, pose, joints[index]).translation;
}

float RandomChain::length() const {
    float sum = 0.0F;
    for (std::size_t i = 1; i < joints.size(); ++i)
        sum += glm::length(pose[joints[i]].translation);
    return sum;
}

float stretchBetween(const Skeleton& skeleton, std::span<const RigidTransform> a, std::span<const RigidTransform> b) {
    std::vector<RigidTransform> modelA(a.size());
    std::vector<RigidTransform> modelB(b.size());
    localToModel(skeleton, a, modelA);
    localToModel(skeleton, b, modelB);
    float worst = 0.0F;
    for (std::size_t joint = 1; joint < a.size(); ++joint) {
        const int parent = skeleton.parents[joint];
        const float lengthA = glm::distance(modelA[joint].translation, modelA[parent].translation);
        const float lengthB = glm::distance(modelB[joint].translation, modelB[parent].translation);
        worst = std::max(worst, std::abs(lengthA - lengthB));
    }
    return worst;
}

float turnBetween(std::span<const RigidTransform> a, std::span<const RigidTransform> b) {
    float worst = 0.0F;
    for (std::size_t joint = 0; joint < a.size(); ++joint)
        worst = std::max(worst, glm::length(rotationVector(glm::conjugate(a[joint].rotation) * b[joint].rotation)));
    return worst;
}

}  // namespace lutka::test
