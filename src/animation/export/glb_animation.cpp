#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

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

template <class Value>
std::vector<Value> kept(const std::vector<Value>& values, const std::vector<int>& frames) {
    std::vector<Value> out;
    out.reserve(frames.size());
    for (const int frame : frames)
        out.push_back(values[static_cast<std::size_t>(frame)]);
    return out;
}

// Kept keys have times of their own, with a place in the file and its JSON: where all keys, whose times every channel
// shares, are no more than that, all are kept.
template <class Value>
const std::vector<int>& smaller(const std::vector<int>& kept, const std::vector<int>& all) {
    constexpr std::size_t kOwnTimes = 200;  // bytes of JSON
    const std::size_t ofKept = kept.size() * (sizeof(Value) + sizeof(float)) + kOwnTimes;
    return ofKept < all.size() * sizeof(Value) ? kept : all;
}

// Neighbouring keys on one side of the sphere, for viewers that blend without looking.
void alignSigns(std::vector<vec4>& rotations) {
    for (std::size_t i = 1; i < rotations.size(); ++i) {
        if (glm::dot(rotations[i], rotations[i - 1]) < 0.0F) rotations[i] = -rotations[i];
    }
}

}  // namespace

AnimationBuilder::AnimationBuilder(const std::string& name, BufferBuilder& buffer, tinygltf::Model& model)
    : buffer_(buffer), model_(model) {
    animation_.name = utf8(name);
}

AnimationBuilder::~AnimationBuilder() = default;

int AnimationBuilder::timesOf(const std::vector<int>& frames, float framesPerSecond) {
    const auto known = times_.find({frames, framesPerSecond});
    if (known != times_.end()) return known->second;
    std::vector<float> seconds;
    seconds.reserve(frames.size());
    for (const int frame : frames)
        seconds.push_back(static_cast<float>(frame) / framesPerSecond);
    const int index = buffer_.addBounded(std::span<const float>(seconds), TINYGLTF_TYPE_SCALAR, 0);
    return times_[{frames, framesPerSecond}] = index;
}

template <class Value>
void AnimationBuilder::addChannel(int node, const char* path, const std::vector<Value>& values, int type,
                                  const std::vector<int>& frames, float framesPerSecond, bool stepped) {
    tinygltf::AnimationSampler sampler;
    sampler.input = timesOf(frames, framesPerSecond);
    sampler.output = buffer_.add(std::span<const Value>(values), TINYGLTF_COMPONENT_TYPE_FLOAT, type, 0);
    sampler.interpolation = stepped ? "STEP" : "LINEAR";
    animation_.samplers.push_back(std::move(sampler));
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation_.samplers.size()) - 1;
    channel.target_node = node;
    channel.target_path = path;
    animation_.channels.push_back(std::move(channel));
}

// Writes the channel when its values leave `rest`; one key is enough for values that stay equal.
template <class Value>
void AnimationBuilder::addValues(int node, const char* path, const std::vector<Value>& values, const Value& rest,
                                 int type, const std::vector<int>& frames, float framesPerSecond, bool stepped) {
    const auto all = std::span(values);
    const bool leaves = std::any_of(all.begin(), all.end(), [&](const Value& value) { return differs(value, rest); });
    const bool moves =
        std::any_of(all.begin(), all.end(), [&](const Value& value) { return differs(value, values.front()); });
    if (!leaves) return;
    static const std::vector<int> kStart{0};
    addChannel(node, path, moves ? values : std::vector<Value>{values.front()}, type, moves ? frames : kStart,
               framesPerSecond, stepped);
}

void AnimationBuilder::add(const Clip& clip, const KeptKeys& keys, std::span<const RigidTransform> parentFromJoint,
                           int firstJoint) {
    const std::size_t joints = parentFromJoint.size();
    LUTKA_ASSERT(clip.parentFromJoint.size() == joints * static_cast<std::size_t>(clip.frameCount));
    std::vector<int> all(static_cast<std::size_t>(clip.frameCount));
    std::iota(all.begin(), all.end(), 0);
    for (std::size_t joint = 0; joint < joints; ++joint) {
        const std::vector<int>& turns = smaller<vec4>(keys.rotations[joint], all);
        const std::vector<int>& moves = smaller<vec3>(keys.translations[joint], all);
        std::vector<vec4> rotations;
        std::vector<vec3> translations;
        for (int frame = 0; frame < clip.frameCount; ++frame) {
            const RigidTransform& pose = clip.parentFromJoint[static_cast<std::size_t>(frame) * joints + joint];
            rotations.push_back(components(pose.rotation));
            translations.push_back(pose.translation);
        }
        rotations = kept(rotations, turns);
        alignSigns(rotations);
        const int node = firstJoint + static_cast<int>(joint);
        const RigidTransform& rest = parentFromJoint[joint];
        addValues(node, "rotation", rotations, components(rest.rotation), TINYGLTF_TYPE_VEC4, turns,
                  clip.framesPerSecond, isMarked(clip.steppedRotations, joint));
        addValues(node, "translation", kept(translations, moves), rest.translation, TINYGLTF_TYPE_VEC3, moves,
                  clip.framesPerSecond, isMarked(clip.steppedTranslations, joint));
    }
}

void AnimationBuilder::finish() {
    if (!animation_.channels.empty()) model_.animations.push_back(std::move(animation_));
}

}  // namespace lutka::animation::glb
