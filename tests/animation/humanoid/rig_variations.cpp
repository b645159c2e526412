#include "rig_variations.hpp"

#include <algorithm>

#include "animation/humanoid/roles.hpp"

#include "core/random.hpp"

namespace lutka::test {
namespace {

template <class Change>
void changePositions(animation::Character& character, const Change& change) {
    for (RigidTransform& frame : character.skeleton.bindModelFromJoint)
        frame.translation = change(frame.translation);
    for (animation::SkinnedMesh& mesh : character.meshes) {
        for (vec3& position : mesh.positions)
            position = change(position);
    }
}

}  // namespace

animation::Character withoutNames(animation::Character character) {
    for (std::size_t i = 0; i < character.skeleton.names.size(); ++i)
        character.skeleton.names[i] = "joint_" + std::to_string(i);
    character.vrmHumanoid.clear();
    return character;
}

animation::Character rotated(animation::Character character, const quat& rotation) {
    changePositions(character, [&](const vec3& p) { return rotation * p; });
    for (RigidTransform& frame : character.skeleton.bindModelFromJoint)
        frame.rotation = rotation * frame.rotation;
    for (animation::SkinnedMesh& mesh : character.meshes) {
        for (vec3& normal : mesh.normals)
            normal = rotation * normal;
    }
    return character;
}

animation::Character scaled(animation::Character character, float factor) {
    changePositions(character, [&](const vec3& p) { return factor * p; });
    for (RigidTransform& frame : character.skeleton.nodeParentFromJoint)
        frame.translation *= factor;
    return character;
}

animation::Character mirrorImage(animation::Character character) {
    changePositions(character, [](const vec3& p) { return vec3(-p.x, p.y, p.z); });
    // A block that the file speaks truth in would have been written the other way round.
    std::map<std::string, int> exchanged;
    for (const auto& [name, joint] : character.vrmHumanoid) {
        const auto role = animation::roleFromName(name);
        exchanged[role ? std::string(roleName(animation::mirrored(*role))) : name] = joint;
    }
    character.vrmHumanoid = std::move(exchanged);
    for (RigidTransform& frame : character.skeleton.bindModelFromJoint) {
        const quat q = frame.rotation;
        frame.rotation = quat(q.w, q.x, -q.y, -q.z);
    }
    for (animation::SkinnedMesh& mesh : character.meshes) {
        for (vec3& normal : mesh.normals)
            normal.x = -normal.x;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
    return character;
}

animation::Character jittered(animation::Character character, float distance, std::uint64_t seed) {
    Random random(seed);
    std::vector<vec3> shifts;
    for (RigidTransform& frame : character.skeleton.bindModelFromJoint) {
        const vec3 shift(random.uniform(-distance, distance), random.uniform(-distance, distance),
                         random.uniform(-distance, distance));
        shifts.push_back(shift);
        frame.translation += shift;
    }
    for (animation::SkinnedMesh& mesh : character.meshes) {
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            mesh.positions[i] += shifts[mesh.joints[i][0]];
    }
    return character;
}

animation::Character shuffled(const animation::Character& character, std::uint64_t seed, std::vector<int>& order) {
    const animation::Skeleton& from = character.skeleton;
    Random random(seed);
    // Roots and children are taken up in random order, always one whose parent is in already.
    order.clear();
    std::vector<int> ready;
    const auto children = animation::childrenOf(from);
    for (int joint = 0; joint < from.jointCount(); ++joint) {
        if (from.parents[joint] == animation::kNoJoint) ready.push_back(joint);
    }
    while (!ready.empty()) {
        const std::size_t pick = random.next() % ready.size();
        const int joint = ready[pick];
        ready.erase(ready.begin() + static_cast<std::ptrdiff_t>(pick));
        order.push_back(joint);
        ready.insert(ready.end(), children[joint].begin(), children[joint].end());
    }
    std::vector<int> newOf(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        newOf[order[i]] = static_cast<int>(i);
    animation::Character result = character;
    animation::Skeleton& to = result.skeleton;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const int old = order[i];
        to.names[i] = from.names[old];
        to.parents[i] = from.parents[old] == animation::kNoJoint ? animation::kNoJoint : newOf[from.parents[old]];
        to.bindModelFromJoint[i] = from.bindModelFromJoint[old];
        to.nodeParentFromJoint[i] = from.nodeParentFromJoint[old];
        to.skinWeight[i] = from.skinWeight[old];
    }
    for (animation::SkinnedMesh& mesh : result.meshes) {
        for (auto& joints : mesh.joints) {
            for (std::uint16_t& joint : joints)
                joint = static_cast<std::uint16_t>(newOf[joint]);
        }
    }
    return result;
}

}  // namespace lutka::test
