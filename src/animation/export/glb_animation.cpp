#include <cmath>
#include <glm/geometric.hpp>

#include "animation/export/glb_parts.hpp"
#include "core/assert.hpp"

namespace lutka::animation::glb {
namespace {

// Below these nobody can tell two frames apart; a channel that stays within them is not written.
constexpr float kSameTranslation = 1e-6F;  // metres
constexpr float kSameRotation = 1e-6F;     // quaternion components

bool differs(const vec3& a, const vec3& b) {
    return glm::length(a - b) > kSameTranslation;
}

bool differs(const vec4& a, const vec4& b) {
    return glm::length(a - b) > kSameRotation && glm::length(a + b) > kSameRotation;
}

vec4 components(const quat& q) {
    return {q.x, q.y, q.z, q.w};
}

bool isMarked(const std::vector<bool>& marks, std::size_t joint) {
    return joint < marks.size() && marks[joint];
}

class AnimationBuilder {
  public:
    AnimationBuilder(const Clip& clip, int firstJoint, BufferBuilder& buffer, tinygltf::Model& model)
        : clip_(clip), firstJoint_(firstJoint), buffer_(buffer), model_(model) {
        animation_.name = utf8(clip.name);
    }

    // Writes the channel when its values leave `rest`; one key is enough for values that stay equal.
    template <class Value>
    void addChannel(std::size_t joint, std::vector<Value> values, const Value& rest, const char* path, int type,
                    bool stepped) {
        bool moves = false;
        bool leaves = false;
        for (const Value& value : values) {
            moves = moves || differs(value, values.front());
            leaves = leaves || differs(value, rest);
        }
        if (!leaves) return;
        if (!moves) values.resize(1);
        tinygltf::AnimationSampler sampler;
        sampler.input = moves ? times() : startTime();
        sampler.output = buffer_.add(std::span<const Value>(values), TINYGLTF_COMPONENT_TYPE_FLOAT, type, 0);
        sampler.interpolation = stepped ? "STEP" : "LINEAR";
        animation_.samplers.push_back(std::move(sampler));
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation_.samplers.size()) - 1;
        channel.target_node = firstJoint_ + static_cast<int>(joint);
        channel.target_path = path;
        animation_.channels.push_back(std::move(channel));
    }

    void finish() {
        if (!animation_.channels.empty()) model_.animations.push_back(std::move(animation_));
    }

  private:
    int addTimes(int count) {
        std::vector<float> seconds(static_cast<std::size_t>(count));
        for (int frame = 0; frame < count; ++frame)
            seconds[static_cast<std::size_t>(frame)] = static_cast<float>(frame) / clip_.framesPerSecond;
        return buffer_.addBounded(std::span<const float>(seconds), TINYGLTF_TYPE_SCALAR, 0);
    }
    int times() { return times_ < 0 ? times_ = addTimes(clip_.frameCount) : times_; }
    int startTime() { return startTime_ < 0 ? startTime_ = addTimes(1) : startTime_; }

    const Clip& clip_;
    int firstJoint_;
    BufferBuilder& buffer_;
    tinygltf::Model& model_;
    tinygltf::Animation animation_;
    int times_ = -1;
    int startTime_ = -1;
};

}  // namespace

void addAnimation(const Clip& clip, std::span<const RigidTransform> parentFromJoint, int firstJoint,
                  BufferBuilder& buffer, tinygltf::Model& model) {
    const std::size_t joints = parentFromJoint.size();
    LUTKA_ASSERT(clip.parentFromJoint.size() == joints * static_cast<std::size_t>(clip.frameCount));
    AnimationBuilder animation(clip, firstJoint, buffer, model);
    for (std::size_t joint = 0; joint < joints; ++joint) {
        std::vector<vec4> rotations;
        std::vector<vec3> translations;
        for (int frame = 0; frame < clip.frameCount; ++frame) {
            const RigidTransform& pose = clip.parentFromJoint[static_cast<std::size_t>(frame) * joints + joint];
            vec4 rotation = components(pose.rotation);
            // Neighbouring keys on one side of the sphere, for viewers that blend without looking.
            if (!rotations.empty() && glm::dot(rotation, rotations.back()) < 0.0F) rotation = -rotation;
            rotations.push_back(rotation);
            translations.push_back(pose.translation);
        }
        const RigidTransform& rest = parentFromJoint[joint];
        animation.addChannel(joint, std::move(rotations), components(rest.rotation), "rotation", TINYGLTF_TYPE_VEC4,
                             isMarked(clip.steppedRotations, joint));
        animation.addChannel(joint, std::move(translations), rest.translation, "translation", TINYGLTF_TYPE_VEC3,
                             isMarked(clip.steppedTranslations, joint));
    }
    animation.finish();
}

}  // namespace lutka::animation::glb
