#include "animation/export/write_bvh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <set>
#include <span>
#include <vector>

#include "animation/pose.hpp"
#include "core/assert.hpp"
#include "core/files.hpp"

namespace lutka::animation {
namespace {

constexpr float kCentimetres = 100.0F;
constexpr float kStays = 1e-5F;  // metres: a translation within this is the offset

std::string bvhName(const std::string& name, std::set<std::string>& taken) {
    std::string word = name.empty() ? "joint" : name;
    std::replace_if(
        word.begin(), word.end(), [](unsigned char c) { return c <= 0x20 || c == '{' || c == '}'; }, '_');
    std::string own = word;
    for (int number = 2; !taken.insert(own).second; ++number)
        own = fmt::format("{}_{}", word, number);
    return own;
}

// Degrees about z, x and y with R = Rz · Rx · Ry.
vec3 anglesZxy(const quat& rotation) {
    const glm::dmat3 m = glm::mat3_cast(glm::normalize(glm::dquat(rotation)));  // m[column][row]
    const double x = std::asin(std::clamp(m[1][2], -1.0, 1.0));
    // Where x is a right angle, z and y turn about one axis: z takes it all.
    const bool locked = std::abs(m[1][2]) > 1.0 - 1e-12;
    const double z = locked ? std::atan2(m[0][1], m[0][0]) : std::atan2(-m[1][0], m[1][1]);
    const double y = locked ? 0.0 : std::atan2(-m[0][2], m[2][2]);
    return {degrees(static_cast<float>(z)), degrees(static_cast<float>(x)), degrees(static_cast<float>(y))};
}

/// Writes a clip of one skeleton.
class BvhWriter {
  public:
    BvhWriter(const Skeleton& skeleton, const Clip& clip, const RigidTransform& worldFromModel)
        : skeleton_(skeleton), clip_(clip), children_(childrenOf(skeleton)), joints_(skeleton.parents.size()) {
        for (const RigidTransform& bind : skeleton.bindModelFromJoint)
            bind_.push_back(worldFromModel * bind);
        std::vector<RigidTransform> pose(joints_);
        for (int frame = 0; frame < clip.frameCount; ++frame) {
            const auto local = std::span(clip.parentFromJoint.data(), clip.parentFromJoint.size())
                                   .subspan(static_cast<std::size_t>(frame) * joints_, joints_);
            localToModel(skeleton, local, pose);
            for (std::size_t joint = 0; joint < joints_; ++joint) {
                const RigidTransform world = worldFromModel * pose[joint];
                world_.push_back({world.rotation * glm::conjugate(bind_[joint].rotation), world.translation});
            }
        }
    }

    std::string write() {
        findMoving();
        append("HIERARCHY\n");
        writeHierarchy();
        append("MOTION\nFrames: {}\nFrame Time: {:.8f}\n", clip_.frameCount,
               1.0 / static_cast<double>(clip_.framesPerSecond));
        for (int frame = 0; frame < clip_.frameCount; ++frame)
            writeFrame(frame);
        return fmt::to_string(out_);
    }

  private:
    template <class... Args>
    void append(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    }

    // A joint in its parent, with the axes of the world in the bind pose.
    [[nodiscard]] RigidTransform placed(int frame, std::size_t joint) const {
        const RigidTransform& own = world_[static_cast<std::size_t>(frame) * joints_ + joint];
        const int parent = skeleton_.parents[joint];
        if (parent == kNoJoint) return own;
        return inverse(world_[static_cast<std::size_t>(frame) * joints_ + static_cast<std::size_t>(parent)]) * own;
    }
    [[nodiscard]] vec3 offsetOf(std::size_t joint) const {
        const int parent = skeleton_.parents[joint];
        return parent == kNoJoint ? vec3(0)
                                  : bind_[joint].translation - bind_[static_cast<std::size_t>(parent)].translation;
    }

    void findMoving() {
        moving_.assign(joints_, false);
        for (std::size_t joint = 0; joint < joints_; ++joint) {
            moving_[joint] = skeleton_.parents[joint] == kNoJoint;
            for (int frame = 0; frame < clip_.frameCount && !moving_[joint]; ++frame)
                moving_[joint] = glm::distance(placed(frame, joint).translation, offsetOf(joint)) > kStays;
        }
    }

    void open(int depth, const std::string& kind, const std::string& name, const vec3& offset) {
        append("{0:{1}}{2} {3}\n{0:{1}}{{\n{0:{1}}  OFFSET {4:.6f} {5:.6f} {6:.6f}\n", "", 2 * depth, kind, name,
               offset.x * kCentimetres, offset.y * kCentimetres, offset.z * kCentimetres);
    }
    void channels(int depth, bool moves) {
        append("{:{}}  CHANNELS {} {}Zrotation Xrotation Yrotation\n", "", 2 * depth, moves ? 6 : 3,
               moves ? "Xposition Yposition Zposition " : "");
    }
    void close(int depth) { append("{:{}}}}\n", "", 2 * depth); }

    // Depth first, without recursion: a chain may be as long as a skeleton has joints.
    void writeHierarchy() {
        std::set<std::string> names;
        std::vector<int> roots;
        for (int joint = 0; joint < skeleton_.jointCount(); ++joint) {
            if (skeleton_.parents[joint] == kNoJoint) roots.push_back(joint);
        }
        addsRoot_ = roots.size() != 1;
        const int top = addsRoot_ ? 1 : 0;
        if (addsRoot_) {
            open(0, "ROOT", bvhName("root", names), vec3(0));
            channels(0, true);
        }
        struct Visit {
            int joint;
            int depth;
            bool leaves;
        };
        std::vector<Visit> stack;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root)
            stack.push_back({*root, top, false});
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            if (visit.leaves) {
                close(visit.depth);
                continue;
            }
            const auto joint = static_cast<std::size_t>(visit.joint);
            order_.push_back(joint);
            open(visit.depth, visit.depth == 0 ? "ROOT" : "JOINT", bvhName(skeleton_.names[joint], names),
                 offsetOf(joint));
            channels(visit.depth, moving_[joint]);
            if (children_[joint].empty()) writeEnd(visit.depth + 1, joint);
            stack.push_back({visit.joint, visit.depth, true});
            for (auto child = children_[joint].rbegin(); child != children_[joint].rend(); ++child)
                stack.push_back({*child, visit.depth + 1, false});
        }
        if (addsRoot_) close(0);
    }

    // Half as far on as the joint is from its parent; a point would have no direction.
    void writeEnd(int depth, std::size_t joint) {
        const vec3 half = 0.5F * offsetOf(joint);
        open(depth, "End", "Site", glm::length(half) > kStays ? half : vec3(0, 0.01F, 0));
        close(depth);
    }

    void writeFrame(int frame) {
        const char* between = "";
        const auto put = [&](float value) {
            append("{}{:.6f}", between, value);
            between = " ";
        };
        for (int i = 0; addsRoot_ && i < 6; ++i)
            put(0.0F);
        for (const std::size_t joint : order_) {
            const RigidTransform place = placed(frame, joint);
            for (int axis = 0; moving_[joint] && axis < 3; ++axis)
                put(place.translation[axis] * kCentimetres);
            const vec3 angles = anglesZxy(place.rotation);
            for (int axis = 0; axis < 3; ++axis)
                put(angles[axis]);
        }
        append("\n");
    }

    const Skeleton& skeleton_;
    const Clip& clip_;
    std::vector<std::vector<int>> children_;
    std::size_t joints_;
    std::vector<RigidTransform> bind_;   // world
    std::vector<RigidTransform> world_;  // frame after frame; rotations from the bind pose
    std::vector<bool> moving_;
    std::vector<std::size_t> order_;
    bool addsRoot_ = false;
    fmt::memory_buffer out_;
};

}  // namespace

std::string bvhText(const Skeleton& skeleton, const Clip& clip, const RigidTransform& worldFromModel) {
    LUTKA_ASSERT(clip.parentFromJoint.size() == skeleton.parents.size() * static_cast<std::size_t>(clip.frameCount));
    return BvhWriter(skeleton, clip, worldFromModel).write();
}

Result<void> writeBvh(const std::filesystem::path& file, const Skeleton& skeleton, const Clip& clip,
                      const RigidTransform& worldFromModel) {
    return writeFileAtomically(file, bvhText(skeleton, clip, worldFromModel));
}

}  // namespace lutka::animation
