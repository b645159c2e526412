#include "animation/import/fbx/blend_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "animation/import/fbx/curve.hpp"

namespace lutka::animation::rig_import::fbx {
namespace {

using glm::dvec3;

// A shape's offsets, weighted, onto the control points; `shares` are percentages of the single offsets, or empty.
void addShape(const Record& shape, double weight, std::span<const double> shares, std::vector<dvec3>& points) {
    const std::vector<double> indices = shape.numbersOf("Indexes");
    const std::vector<double> offsets = shape.numbersOf("Vertices");
    for (std::size_t i = 0; i < indices.size() && 3 * i + 2 < offsets.size(); ++i) {
        if (!(indices[i] >= 0.0 && indices[i] < static_cast<double>(points.size()))) continue;
        if (!shares.empty() && i >= shares.size()) return;
        const dvec3 offset(offsets[3 * i], offsets[3 * i + 1], offsets[3 * i + 2]);
        if (std::isfinite(offset.x + offset.y + offset.z))
            points[static_cast<std::size_t>(indices[i])] +=
                weight * (shares.empty() ? 1.0 : shares[i] / 100.0) * offset;
    }
}

// The percentages at which a channel's shapes count in full; 100 where the file states none.
std::vector<double> fullPercentages(std::vector<double> stated, std::size_t shapes) {
    stated.resize(shapes, 100.0);
    return stated;
}

// How much each of a channel's shapes counts at a percentage: between two neighbours in proportion, with the undeformed
// mesh at 0 among them, and beyond the ends straight on.
std::vector<double> shapeWeights(double percent, const std::vector<double>& full) {
    constexpr std::size_t kUndeformed = static_cast<std::size_t>(-1);
    std::vector<std::pair<double, std::size_t>> keys = {{0.0, kUndeformed}};
    for (std::size_t i = 0; i < full.size(); ++i)
        if (std::isfinite(full[i])) keys.emplace_back(full[i], i);
    // Of several at one percentage the first counts.
    std::stable_sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto atOne = [](const auto& a, const auto& b) { return a.first == b.first; };
    keys.erase(std::unique(keys.begin(), keys.end(), atOne), keys.end());
    std::vector<double> weights(full.size(), 0.0);
    if (keys.size() < 2) return weights;
    const auto atOrAbove =
        std::find_if(keys.begin() + 1, keys.end() - 1, [&](const auto& key) { return key.first >= percent; });
    const auto& [low, lowShape] = *(atOrAbove - 1);
    const auto& [high, highShape] = *atOrAbove;
    const double way = (percent - low) / (high - low);
    if (highShape != kUndeformed) weights[highShape] = way;
    if (lowShape != kUndeformed) weights[lowShape] = 1.0 - way;
    return weights;
}

// The geometry's own numbers by their names.
std::unordered_map<std::string_view, double> numbersOf(const Record& geometry) {
    std::unordered_map<std::string_view, double> numbers;
    for (const char* name : {"Properties60", "Properties70"}) {
        const Record* list = geometry.child(name);
        if (list == nullptr) continue;
        for (const Record& property : list->children)
            numbers[property.text(0)] = property.number(property.name == "P" ? 4 : 3);
    }
    return numbers;
}

// Those in the geometry itself, at the property of their name.
void addOwnShapes(const Record& geometry, std::vector<dvec3>& points) {
    if (geometry.child("Shape") == nullptr) return;
    const auto percentages = numbersOf(geometry);
    for (const Record& shape : geometry.children) {
        if (shape.name != "Shape") continue;
        const auto percent = percentages.find(shape.text(0));
        if (percent != percentages.end() && std::abs(percent->second) > 1e-6)
            addShape(shape, percent->second / 100.0, {}, points);
    }
}

std::unordered_set<std::string_view> ownShapesOf(const Record& geometry) {
    std::unordered_set<std::string_view> names;
    for (const Record& shape : geometry.children) {
        if (shape.name == "Shape") names.insert(shape.text(0));
    }
    return names;
}

// Whether a take (FBX 6) moves a shape of a model.
bool movesShape(const Record& take, const Objects& objects, double ticksPerSecond) {
    for (const Record& model : take.children) {
        const int index = model.name == "Model" ? objects.indexOf(model, 0) : -1;
        if (index < 0) continue;
        const auto shapes = ownShapesOf(*objects[index].record);
        for (const Record& channel : model.children) {
            if (channel.name != "Channel" || shapes.count(channel.text(0)) == 0) continue;
            const std::optional<Curve> curve = readChannel(channel, ticksPerSecond);
            if (curve && curve->moves()) return true;
        }
    }
    return false;
}

}  // namespace

void addBlendShapes(const Objects& objects, int geometry, std::vector<dvec3>& points) {
    addOwnShapes(*objects[geometry].record, points);
    for (const int blend : objects.children(geometry, "Deformer", "BlendShape")) {
        for (const int channel : objects.children(blend, "Deformer", "BlendShapeChannel")) {
            const Object& object = objects[channel];
            const Record* stated = object.record->child("DeformPercent");
            const double percent = object.properties.number("DeformPercent", stated ? stated->number(0) : 0.0);
            if (!(std::abs(percent) > 1e-6)) continue;
            const std::vector<int> shapes = objects.children(channel, "Geometry");
            const std::vector<double> full = object.record->numbersOf("FullWeights");
            // Blender's exporter keeps a vertex group there: a percentage for each of the shape's offsets.
            const bool perOffset = full.size() != shapes.size();
            const std::vector<double> weights =
                shapeWeights(percent, fullPercentages(perOffset ? std::vector<double>{} : full, shapes.size()));
            for (std::size_t i = 0; i < shapes.size(); ++i) {
                if (weights[i] != 0.0)
                    addShape(*objects[shapes[i]].record, weights[i], perOffset ? full : std::vector<double>{}, points);
            }
        }
    }
}

bool movesBlendShapes(const Document& document, const Objects& objects) {
    const auto moves = [&](int curve) {
        const std::optional<Curve> read = readCurve(*objects[curve].record, document.ticksPerSecond);
        return read && read->moves();
    };
    for (int object = 0; object < static_cast<int>(objects.all().size()); ++object) {
        const bool isChannel = objects[object].kind == "Deformer" && objects[object].subKind == "BlendShapeChannel";
        if (!isChannel && objects[object].kind != "Geometry") continue;
        const auto shapes = isChannel ? std::unordered_set<std::string_view>{} : ownShapesOf(*objects[object].record);
        for (const Connection& node : objects.childrenOf(object)) {
            if (objects[node.child].kind != "AnimationCurveNode") continue;
            if (!isChannel && shapes.count(node.property) == 0) continue;
            if (std::ranges::any_of(objects.children(node.child, "AnimationCurve"), moves)) return true;
        }
    }
    const Record* takes = document.root.child("Takes");
    if (takes == nullptr || document.version >= 7000) return false;
    return std::any_of(takes->children.begin(), takes->children.end(), [&](const Record& take) {
        return take.name == "Take" && movesShape(take, objects, document.ticksPerSecond);
    });
}

}  // namespace lutka::animation::rig_import::fbx
