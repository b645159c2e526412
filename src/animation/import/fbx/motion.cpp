#include "animation/import/fbx/motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string_view>

namespace lutka::animation::rig_import::fbx {
namespace {

std::optional<Part> partNamed(std::string_view property) {
    for (std::size_t i = 0; i < kPartCount; ++i) {
        if (nameOf(static_cast<Part>(i)) == property) return static_cast<Part>(i);
    }
    return std::nullopt;
}

bool hasCurves(const AnimatedPart& part) {
    return std::any_of(part.curves.begin(), part.curves.end(), [](const auto& curve) { return curve.has_value(); });
}

// Reads stacks and takes of one document.
class MotionReader {
  public:
    MotionReader(const Document& document, const Objects& objects, const std::map<int, int>& nodeOfModel)
        : ticks_(document.ticksPerSecond), objects_(objects), nodeOfModel_(nodeOfModel) {}

    [[nodiscard]] Motion readStack(int index) const;
    [[nodiscard]] Motion readTake(const Record& take) const;

  private:
    [[nodiscard]] AnimatedPart readCurveNode(int index, int node, Part part) const;
    [[nodiscard]] MotionLayer readLayer(int index, bool first) const;
    [[nodiscard]] std::optional<AnimatedPart> readTakePart(const Record& channel, int node) const;
    [[nodiscard]] std::optional<std::pair<double, double>> spanOf(double startTicks, double stopTicks) const;

    double ticks_;
    const Objects& objects_;
    const std::map<int, int>& nodeOfModel_;
};

AnimatedPart MotionReader::readCurveNode(int index, int node, Part part) const {
    const Properties& properties = objects_[index].properties;
    AnimatedPart out;
    out.node = node;
    out.part = part;
    constexpr std::array<std::string_view, 3> kCoordinates = {"d|X", "d|Y", "d|Z"};
    for (int i = 0; i < 3; ++i) {
        const auto place = static_cast<std::size_t>(i);
        out.defaults[i] = properties.number(kCoordinates[place], part == Part::scaling ? 1.0 : 0.0);
        const int curve = objects_.childAt(index, kCoordinates[place], "AnimationCurve");
        if (curve >= 0) out.curves[place] = readCurve(*objects_[curve].record, ticks_);
    }
    return out;
}

MotionLayer MotionReader::readLayer(int index, bool first) const {
    MotionLayer layer;
    const Properties& properties = objects_[index].properties;
    layer.weight = std::clamp(properties.number("Weight", 100.0) / 100.0, 0.0, 1.0);
    const std::int64_t mode = properties.integer("BlendMode", 0);
    if (!first) layer.blend = mode == 0 ? Blend::add : (mode == 2 ? Blend::mix : Blend::replace);
    if (const int weight = objects_.childAt(index, "Weight", "AnimationCurveNode"); weight >= 0) {
        const int curve = objects_.childAt(weight, "d|Weight", "AnimationCurve");
        if (curve >= 0) layer.weights = readCurve(*objects_[curve].record, ticks_);
    }
    layer.rotationsByAngle = properties.integer("RotationAccumulationMode", 0) != 0;
    layer.scalesAdd = properties.integer("ScaleAccumulationMode", 0) != 0;
    for (const int curveNode : objects_.children(index, "AnimationCurveNode")) {
        for (const Connection& target : objects_.parentsOf(curveNode)) {
            const auto node = nodeOfModel_.find(target.parent);
            const std::optional<Part> part = partNamed(target.property);
            if (node == nodeOfModel_.end() || !part) continue;
            layer.parts.push_back(readCurveNode(curveNode, node->second, *part));
        }
    }
    return layer;
}

std::optional<std::pair<double, double>> MotionReader::spanOf(double startTicks, double stopTicks) const {
    const std::pair<double, double> span(startTicks / ticks_, stopTicks / ticks_);
    if (!(span.second > span.first) || !std::isfinite(span.second - span.first)) return std::nullopt;
    return span;
}

Motion MotionReader::readStack(int index) const {
    Motion motion;
    const Object& stack = objects_[index];
    motion.name = stack.name;
    motion.span = spanOf(stack.properties.number("LocalStart", 0.0), stack.properties.number("LocalStop", 0.0));
    bool first = true;
    for (const int layerIndex : objects_.children(index, "AnimationLayer")) {
        const bool mute = objects_[layerIndex].properties.integer("Mute", 0) != 0;
        MotionLayer layer = readLayer(layerIndex, first);
        first = false;
        const bool counts = !mute && (layer.weight > 0.0 || layer.weights);
        if (!layer.parts.empty() && counts) motion.layers.push_back(std::move(layer));
    }
    return motion;
}

// A take's channel "T", "R" or "S" of a model.
std::optional<AnimatedPart> MotionReader::readTakePart(const Record& channel, int node) const {
    AnimatedPart out;
    out.node = node;
    const std::string_view name = channel.text(0);
    if (name != "T" && name != "R" && name != "S") return std::nullopt;
    out.part = name == "T" ? Part::translation : (name == "R" ? Part::rotation : Part::scaling);
    out.defaults = dvec3(name == "S" ? 1.0 : 0.0);
    bool states = false;  // a take's value counts without any keys
    for (const Record& coordinate : channel.children) {
        const std::string_view axis = coordinate.name == "Channel" ? coordinate.text(0) : std::string_view{};
        if (axis.size() != 1 || axis[0] < 'X' || axis[0] > 'Z') continue;
        const int place = axis[0] - 'X';
        if (const Record* value = coordinate.child("Default"); value != nullptr) {
            out.defaults[place] = value->number(0, out.defaults[place]);
            states = true;
        }
        out.curves[static_cast<std::size_t>(place)] = readChannel(coordinate, ticks_);
    }
    return states || hasCurves(out) ? std::optional(std::move(out)) : std::nullopt;
}

Motion MotionReader::readTake(const Record& take) const {
    Motion motion;
    motion.name = std::string(take.text(0));
    if (const Record* span = take.child("LocalTime"); span != nullptr)
        motion.span = spanOf(span->number(0), span->number(1));
    MotionLayer layer;
    for (const Record& model : take.children) {
        const int index = model.name == "Model" ? objects_.indexOf(model, 0) : -1;
        const auto node = nodeOfModel_.find(index);
        if (node == nodeOfModel_.end()) continue;
        for (const Record& transform : model.children) {
            if (transform.name != "Channel" || transform.text(0) != "Transform") continue;
            for (const Record& channel : transform.children) {
                if (auto part = readTakePart(channel, node->second)) layer.parts.push_back(*std::move(part));
            }
        }
    }
    if (!layer.parts.empty()) motion.layers.push_back(std::move(layer));
    return motion;
}

// Curve nodes without curves only hold a node still.
bool moves(const Motion& motion) {
    return std::any_of(motion.layers.begin(), motion.layers.end(), [](const MotionLayer& layer) {
        return std::any_of(layer.parts.begin(), layer.parts.end(), hasCurves);
    });
}

dmat3 shareOf(const dmat3& rotation, double weight) {
    const glm::dquat whole = glm::quat_cast(rotation);
    return glm::mat3_cast(glm::slerp(glm::dquat(1, 0, 0, 0), whole, weight));
}

dvec3 combine(const MotionLayer& layer, double weight, Part part, int order, const dvec3& below, const dvec3& value) {
    if (layer.blend == Blend::replace) return value;
    const bool turns = part == Part::rotation && !layer.rotationsByAngle;
    if (layer.blend == Blend::mix) {
        if (!turns) return below * (1.0 - weight) + value * weight;
        const dmat3 from = rotationFromEuler(below, order);
        return eulerFromRotation(from * shareOf(glm::transpose(from) * rotationFromEuler(value, order), weight), order);
    }
    if (turns)
        return eulerFromRotation(rotationFromEuler(below, order) * shareOf(rotationFromEuler(value, order), weight),
                                 order);
    if (part == Part::scaling && !layer.scalesAdd) {
        dvec3 out = below;
        for (int i = 0; i < 3; ++i)
            out[i] *= std::copysign(std::pow(std::abs(value[i]), weight), value[i]);
        return out;
    }
    return below + weight * value;
}

}  // namespace

dvec3 AnimatedPart::at(double seconds) const {
    dvec3 out = defaults;
    for (int i = 0; i < 3; ++i) {
        const auto& curve = curves[static_cast<std::size_t>(i)];
        if (curve) out[i] = curve->at(seconds);
    }
    return out;
}

std::vector<Motion> readMotions(const Document& document, const Objects& objects,
                                const std::map<int, int>& nodeOfModel) {
    std::vector<Motion> motions;
    const MotionReader reader(document, objects, nodeOfModel);
    for (int i = 0; i < static_cast<int>(objects.all().size()); ++i) {
        if (objects[i].kind == "AnimationStack") motions.push_back(reader.readStack(i));
    }
    const Record* takes = document.root.child("Takes");
    const bool old = motions.empty() && takes != nullptr;
    for (std::size_t i = 0; old && i < takes->children.size(); ++i) {
        const Record& take = takes->children[i];
        if (take.name == "Take") motions.push_back(reader.readTake(take));
    }
    std::erase_if(motions, [](const Motion& motion) { return !moves(motion); });
    return motions;
}

void MotionPlayer::pose(double seconds, std::vector<NodeTransform>& out) const {
    out = own_;
    for (const MotionLayer& layer : motion_.layers) {
        const double weight = layer.weights ? std::clamp(layer.weights->at(seconds) / 100.0, 0.0, 1.0) : layer.weight;
        for (const AnimatedPart& animated : layer.parts) {
            NodeTransform& transform = out[static_cast<std::size_t>(animated.node)];
            const int order = transform.rotationSpace ? transform.rotationOrder : 0;
            transform[animated.part] =
                combine(layer, weight, animated.part, order, transform[animated.part], animated.at(seconds));
        }
    }
}

}  // namespace lutka::animation::rig_import::fbx
