#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "animation/import/gltf/accessor.hpp"
#include "animation/import/gltf/gltf_parts.hpp"

namespace lutka::animation::rig_import::gltf {
namespace {

using nlohmann::json;
using Interpolation = SourceChannel::Interpolation;

std::optional<SourceChannel::Path> pathOf(const std::string& name) {
    if (name == "translation") return SourceChannel::Path::translation;
    if (name == "rotation") return SourceChannel::Path::rotation;
    if (name == "scale") return SourceChannel::Path::scale;
    return std::nullopt;
}

Interpolation interpolationOf(const std::string& name, GltfFile& file) {
    if (name == "STEP") return Interpolation::step;
    if (!name.empty() && name != "LINEAR" && name != "CUBICSPLINE")
        file.leaveOut("interpolations of animations that glTF does not know: straight from key to key");
    return name == "CUBICSPLINE" ? Interpolation::cubicSpline : Interpolation::linear;
}

// The keys in the order of their times; false where the file has another, which the standard forbids. Keys whose time
// is not finite are left out.
bool takeKeys(const Numbers& times, const Numbers& values, SourceChannel& channel, GltfFile& file) {
    const std::size_t parts = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
    const std::size_t perKey = parts * values.width;
    const std::size_t keys = std::min(times.count, values.count / parts);
    if (keys < times.count) file.leaveOut("keys of animations that have no value");
    if (values.count > times.count * parts) file.leaveOut("values of animations beyond their last key");
    std::vector<std::size_t> order;
    order.reserve(keys);
    for (std::size_t key = 0; key < keys; ++key) {
        if (std::isfinite(times.at(key, 0)))
            order.push_back(key);
        else
            file.leaveOut("keys of animations whose time is no number");
    }
    const auto earlier = [&](std::size_t a, std::size_t b) { return times.at(a, 0) < times.at(b, 0); };
    const bool isSorted = std::is_sorted(order.begin(), order.end(), earlier);
    if (!isSorted) std::stable_sort(order.begin(), order.end(), earlier);
    channel.times.reserve(keys);
    channel.values.reserve(keys * perKey);
    for (const std::size_t key : order) {
        channel.times.push_back(times.at(key, 0));
        const auto first = values.values.begin() + static_cast<std::ptrdiff_t>(key * perKey);
        channel.values.insert(channel.values.end(), first, first + static_cast<std::ptrdiff_t>(perKey));
    }
    return isSorted;
}

// What a channel moves: a node, and which part of it by glTF's name.
struct Target {
    int node = -1;
    std::string path;
};

// The target of KHR_animation_pointer, a JSON pointer: "/nodes/3/rotation".
std::optional<Target> pointedAt(const std::string& pointer, std::size_t nodes) {
    constexpr std::string_view kNodes = "/nodes/";
    if (!pointer.starts_with(kNodes)) return std::nullopt;
    Target target;
    const char* const first = pointer.data() + kNodes.size();
    const char* const end = pointer.data() + pointer.size();
    const auto [rest, error] = std::from_chars(first, end, target.node);
    if (error != std::errc() || rest == end || *rest != '/') return std::nullopt;
    if (target.node < 0 || static_cast<std::size_t>(target.node) >= nodes) return std::nullopt;
    target.path = std::string(rest + 1, end);
    return target;
}

std::optional<Target> targetOf(const json& channel, std::size_t nodes) {
    const json* target = member(channel, "target");
    if (target == nullptr) return std::nullopt;
    if (const json* block = extensionOf(*target, "KHR_animation_pointer"))
        return pointedAt(textOf(*block, "pointer"), nodes).value_or(Target{});
    const std::optional<int> node = indexOf(*target, "node", nodes);
    return node ? std::optional(Target{*node, textOf(*target, "path")}) : std::nullopt;
}

void addChannel(GltfFile& file, const json& animation, const json& source, const NodeMap& nodes, SourceClip& clip,
                std::string& unsorted) {
    const std::optional<Target> target = targetOf(source, nodes.size());
    if (!target) return;  // the specification has such a channel ignored
    const std::optional<SourceChannel::Path> path = pathOf(target->path);
    if (!path) {
        const bool morphs = target->path == "weights";
        file.leaveOut(morphs ? "animations of morph targets" : "animations of other things than nodes");
        return;
    }
    const std::optional<int> samplerIndex = indexOf(source, "sampler", countOf(animation, "samplers"));
    if (!samplerIndex) {
        file.leaveOut("channels of animations without a sampler");
        return;
    }
    if (nodes[target->node] < 0) {
        file.leaveOut("animations of nodes that are not in the scene");
        return;
    }
    const json& sampler = animation.at("samplers").at(static_cast<std::size_t>(*samplerIndex));
    const std::optional<int> input = indexOf(sampler, "input", file.count("accessors"));
    const std::optional<int> output = indexOf(sampler, "output", file.count("accessors"));
    if (!input || !output) throw Damage{fmt::format("'{}' has a sampler without keys", clip.name)};
    SourceChannel channel;
    channel.node = nodes[target->node];
    channel.path = *path;
    channel.interpolation = interpolationOf(textOf(sampler, "interpolation"), file);
    const std::size_t width = *path == SourceChannel::Path::rotation ? 4 : 3;
    const bool isSorted = takeKeys(readNumbers(file, *input, 1, "key times"),
                                   readNumbers(file, *output, width, "key values"), channel, file);
    if (!isSorted && unsorted.empty()) unsorted = fmt::format("animation '{}'", clip.name);
    if (!channel.times.empty()) clip.channels.push_back(std::move(channel));
}

// Of channels that move the same part of a node, which the standard forbids, the last is what most programs show.
void keepLastOfEach(SourceClip& clip, GltfFile& file) {
    std::set<std::pair<int, SourceChannel::Path>> taken;
    std::vector<SourceChannel> kept;
    for (auto channel = clip.channels.rbegin(); channel != clip.channels.rend(); ++channel) {
        if (taken.emplace(channel->node, channel->path).second) kept.push_back(std::move(*channel));
    }
    if (kept.size() < clip.channels.size())
        file.leaveOut("of several channels of an animation that move the same part of a node all but the last");
    clip.channels.assign(std::make_move_iterator(kept.rbegin()), std::make_move_iterator(kept.rend()));
}

}  // namespace

std::vector<bool> nodesOfPointers(const GltfFile& file, std::string_view part) {
    std::vector<bool> found(file.count("nodes"), false);
    for (std::size_t i = 0; i < file.count("animations"); ++i) {
        const json* channels = arrayOf(file.element("animations", static_cast<int>(i)), "channels");
        for (std::size_t c = 0; channels != nullptr && c < channels->size(); ++c) {
            const std::optional<Target> target = targetOf((*channels)[c], found.size());
            if (target && target->node >= 0 && target->path == part) found[target->node] = true;
        }
    }
    return found;
}

void addClips(GltfFile& file, const NodeMap& nodes, SourceScene& out) {
    std::string unsorted;  // the first of whose keys are
    for (std::size_t i = 0; i < file.count("animations"); ++i) {
        const json& source = file.element("animations", static_cast<int>(i));
        SourceClip clip;
        clip.name = textOf(source, "name");
        const json* channels = arrayOf(source, "channels");
        for (std::size_t c = 0; channels != nullptr && c < channels->size(); ++c)
            within("animations", static_cast<int>(i),
                   [&] { addChannel(file, source, (*channels)[c], nodes, clip, unsorted); });
        keepLastOfEach(clip, file);
        out.clips.push_back(std::move(clip));
    }
    if (!unsorted.empty())
        out.warnings.push_back(
            fmt::format("keys stood in another order than that of their times and were sorted: {}", unsorted));
}

}  // namespace lutka::animation::rig_import::gltf
