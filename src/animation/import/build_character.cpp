#include "animation/import/build_character.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <memory>
#include <utility>

#include "animation/import/bare_skeleton.hpp"
#include "animation/import/bind_pose.hpp"
#include "animation/import/clean_source.hpp"
#include "animation/import/clip_sampling.hpp"
#include "animation/import/figure_choice.hpp"
#include "animation/import/hidden_meshes.hpp"
#include "animation/import/humanoid_block.hpp"
#include "animation/import/inside_out.hpp"
#include "animation/import/mesh_conversion.hpp"
#include "animation/import/node_tree.hpp"
#include "animation/import/rigid_pose.hpp"
#include "animation/import/units.hpp"
#include "animation/import/vertex_order.hpp"
#include "animation/pose.hpp"
#include "core/utf8.hpp"

namespace lutka::animation::rig_import {
namespace {

// Scale that a joint has in a pose but not in the bind pose is dropped; below this share nobody sees it.
constexpr double kVisibleScale = 0.01;
constexpr std::size_t kFewestJointsOfFigure = 8;

// The root of the part of the tree that holds most joints: leaves out cameras, lights and helpers beside the figure, of
// which MotionBuilder writes seven. They are single nodes or two; what has more joints beside it is a limb's neighbour.
int rootOfFigure(const Skeleton& skeleton) {
    constexpr int kMostOfHelper = 2;
    const int count = skeleton.jointCount();
    std::vector<int> size(count, 1);
    for (int joint = count - 1; joint > 0; --joint) {
        if (skeleton.parents[joint] != kNoJoint) size[skeleton.parents[joint]] += size[joint];
    }
    int figure = 0;
    for (int root = 0; root != kNoJoint;) {
        int largest = kNoJoint;
        int second = 0;  // joints of the largest of the others
        for (int joint = root + 1; joint < count; ++joint) {
            if (skeleton.parents[joint] != root) continue;
            if (largest != kNoJoint) second = std::max(second, std::min(size[joint], size[largest]));
            if (largest == kNoJoint || size[joint] > size[largest]) largest = joint;
        }
        const bool dominates = largest != kNoJoint && 2 * size[largest] > size[root] && second <= kMostOfHelper;
        if (dominates && second > 0) figure = largest;
        root = dominates ? largest : kNoJoint;
    }
    return figure;
}

// Whether the points lie about at least a share of the joints: a sphere at the hips of a bare skeleton is no figure's
// skin, and neither is a face, though many joints move hair.
bool cover(const std::vector<vec3>& points, const std::vector<vec3>& joints, double leastShare) {
    constexpr float kMargin = 0.2F;  // of the points' box, on each side
    vec3 low(std::numeric_limits<float>::max());
    vec3 high(std::numeric_limits<float>::lowest());
    for (const vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const vec3 margin(kMargin * glm::length(high - low));
    const auto inside = std::count_if(joints.begin(), joints.end(), [&](const vec3& joint) {
        return glm::all(glm::greaterThan(joint, low - margin)) && glm::all(glm::lessThan(joint, high + margin));
    });
    return static_cast<double>(inside) >= leastShare * static_cast<double>(joints.size());
}

// Marks the joints that are the figure's: all below its root but single nodes on it, far from where most of them are
// (cameras and lights beside several hierarchies).
std::vector<bool> jointsOfFigure(const Skeleton& skeleton, std::span<const dmat4> bind) {
    constexpr double kFar = 4.0;  // of the distance from the middle that four in five keep
    const int root = rootOfFigure(skeleton);
    const auto count = static_cast<std::size_t>(skeleton.jointCount());
    std::vector<bool> of(count, false);
    std::vector<bool> isLeaf(count, true);
    std::array<std::vector<double>, 3> places;
    for (std::size_t joint = 0; joint < count; ++joint) {
        of[joint] = isAncestorOrSelf(skeleton, root, static_cast<int>(joint));
        if (skeleton.parents[joint] != kNoJoint) isLeaf[static_cast<std::size_t>(skeleton.parents[joint])] = false;
        for (int axis = 0; of[joint] && axis < 3; ++axis)
            places[static_cast<std::size_t>(axis)].push_back(bind[joint][3][axis]);
    }
    if (places[0].size() < kFewestJointsOfFigure) return of;
    const auto quantile = [](std::vector<double>& values, double share) {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), at, values.end());
        return *at;
    };
    const dvec3 middle(quantile(places[0], 0.5), quantile(places[1], 0.5), quantile(places[2], 0.5));
    std::vector<double> distances;
    for (std::size_t joint = 0; joint < count; ++joint) {
        if (of[joint]) distances.push_back(glm::distance(dvec3(bind[joint][3]), middle));
    }
    const double most = kFar * quantile(distances, 0.8);
    for (std::size_t joint = 0; joint < count; ++joint) {
        const bool alone = isLeaf[joint] && skeleton.parents[joint] == root;
        if (alone && glm::distance(dvec3(bind[joint][3]), middle) > most) of[joint] = false;
    }
    return of;
}

struct FigurePoints {
    std::vector<vec3> points;
    std::vector<bool> joints;  // marks those of the figure
    bool meshesCover = true;   // the meshes lie about the skeleton: they tell which of its joints are the figure's
};

// What the height of the figure is measured on: skins and their joints, else rigid meshes; the joints, too, where these
// cover few of them or are not there.
FigurePoints pointsOfFigure(Character& character, std::span<const dmat4> bind) {
    std::vector<vec3> points;
    bool skinned = false;
    for (const SkinnedMesh& mesh : character.meshes)
        skinned = skinned || !mesh.rigid;
    for (const SkinnedMesh& mesh : character.meshes) {
        if (skinned == !mesh.rigid) points.insert(points.end(), mesh.positions.begin(), mesh.positions.end());
    }
    std::vector<vec3> joints;
    const std::vector<bool> ofFigure = jointsOfFigure(character.skeleton, bind);
    for (int joint = 0; joint < character.skeleton.jointCount(); ++joint) {
        const bool deforms = character.skeleton.skinWeight[joint] > 0.0F && skinned;
        if (deforms) points.emplace_back(bind[joint][3]);
        if (ofFigure[static_cast<std::size_t>(joint)]) joints.emplace_back(bind[joint][3]);
    }
    constexpr double kLeastOfSkin = 0.3;
    constexpr double kLeastOfParts = 0.6;
    const double least = skinned ? kLeastOfSkin : kLeastOfParts;
    if (!points.empty() && (joints.size() < kFewestJointsOfFigure || cover(points, joints, least)))
        return {points, ofFigure, true};
    if (!points.empty()) {
        character.warnings.emplace_back(
            "the meshes lie about hardly any of the skeleton's joints: the figure's height is that of the joints");
    }
    points.insert(points.end(), joints.begin(), joints.end());
    return {points, ofFigure, false};
}

void settleMeshes(const UnitsAndAxes& units, std::vector<SkinnedMesh>& meshes) {
    const mat3 rotation(units.rotation);
    const mat3 scaled(units.scale * units.rotation);
    for (SkinnedMesh& mesh : meshes) {
        for (vec3& position : mesh.positions)
            position = scaled * position + vec3(units.translation);
        for (vec3& normal : mesh.normals)
            normal = rotation * normal;
        for (vec4& tangent : mesh.tangents)
            tangent = vec4(rotation * vec3(tangent), tangent.w);
    }
}

// Joints that move no skin and stand far from all that do (the root of an armature that was moved) would make the
// figure as large as the way there: they stand at the origin instead. Of a file without a skin, or with one that covers
// hardly any joints (a plane beside an armature), all joints below the figure's root count as its own.
void bringAlong(const UnitsAndAxes& units, const Skeleton& skeleton, const FigurePoints& figure,
                std::span<dmat4> bind) {
    constexpr double kFar = 4.0;  // reaches of the skin and its joints
    const dmat4 modelFromScene = units.modelFromScene();
    const auto away = [&](std::size_t joint) { return glm::length(dvec3(modelFromScene * bind[joint][3])); };
    const auto weighs = [](float weight) { return weight > 0.0F; };
    const bool skinned =
        figure.meshesCover && std::any_of(skeleton.skinWeight.begin(), skeleton.skinWeight.end(), weighs);
    const auto isOfFigure = [&](std::size_t joint) {
        return skinned ? weighs(skeleton.skinWeight[joint]) : static_cast<bool>(figure.joints[joint]);
    };
    double reach = 0.0;
    for (std::size_t joint = 0; joint < bind.size(); ++joint) {
        if (isOfFigure(joint)) reach = std::max(reach, away(joint));
    }
    // A mesh that no joint moves hangs on its own node, which may stand at the origin: its skin reaches all the same.
    for (const vec3& point : figure.points)
        reach = std::max(reach, glm::length(dvec3(modelFromScene * dvec4(dvec3(point), 1.0))));
    const dmat4 sceneFromModel = glm::inverse(modelFromScene);
    for (std::size_t joint = 0; reach > 0.0 && joint < bind.size(); ++joint) {
        if (!isOfFigure(joint) && away(joint) > kFar * reach) bind[joint][3] = sceneFromModel[3];
    }
}

void poseNodes(const ClipFile& file, Character& character) {
    std::vector<dmat4> sceneFromNode;
    sceneFromNode.reserve(file.tree.nodes.size());
    for (const NodeTree::Node& node : file.tree.nodes)
        sceneFromNode.push_back(node.sceneFromNode);
    std::vector<RigidTransform> modelFromJoint(file.tree.nodeOfJoint.size());
    const double common = file.poser.commonScale(sceneFromNode, file.matters());
    const bool otherUnit = std::abs(common - 1.0) > kAnotherUnit;
    if (otherUnit) {
        character.warnings.push_back(
            fmt::format("the nodes' pose is {:.3g} times the size of the bind pose and was brought to it", common));
    }
    const double worst = file.poser.pose(sceneFromNode, otherUnit ? common : 1.0, file.matters(), modelFromJoint);
    modelToLocal(character.skeleton, modelFromJoint, character.skeleton.nodeParentFromJoint);
    if (worst > kVisibleScale) {
        character.warnings.push_back(
            fmt::format("the nodes' pose scales joints by up to {:.1f} % against the bind pose; the scale was dropped",
                        100.0 * worst));
    }
}

// Skeleton and clips from the solved bind pose and the settled units.
void buildMotion(SourceScene& source, const NodeTree& tree, std::span<const dmat4> bind, const UnitsAndAxes& units,
                 Character& character) {
    const auto file = std::make_shared<ClipFile>(tree, bind, units.modelFromScene(), character.skeleton, source);
    character.skeleton.bindModelFromJoint = file->poser.bindModelFromJoint();
    character.skeleton.nodeParentFromJoint.resize(tree.nodeOfJoint.size());
    if (!tree.nodesArePosed) {
        modelToLocal(character.skeleton, file->poser.bindModelFromJoint(), character.skeleton.nodeParentFromJoint);
        character.warnings.push_back("the file's joint hierarchy and clips can't be read; the bind pose can");
        return;
    }
    poseNodes(*file, character);
    character.clips = sampleAnimations(file, character.warnings);
}

void takeMaterials(SourceScene& source, Character& character) {
    character.materials = std::move(source.materials);
    character.textures = std::move(source.textures);
    // Meshes without a material get one of their own: the first may be a glass eye's.
    const auto count = static_cast<int>(character.materials.size());
    for (SkinnedMesh& mesh : character.meshes) {
        if (mesh.material < 0 || mesh.material >= count) mesh.material = count;
        if (mesh.material == static_cast<int>(character.materials.size())) character.materials.emplace_back();
    }
}

// A single unseen mesh is meant so (the glass of an eye); of a whole figure it is what an exporter took the colour's
// fourth number for.
void showUnseen(Character& character) {
    constexpr float kSeen = 0.01F;  // of the colour's alpha, where the material blends
    const auto isUnseen = [&](const SkinnedMesh& mesh) {
        const Material& material = character.materials[static_cast<std::size_t>(mesh.material)];
        if (material.alphaMode == Material::AlphaMode::opaque) return false;
        const bool cut = material.alphaMode == Material::AlphaMode::mask;
        return material.baseColor.a < (cut ? std::max(material.alphaCutoff, kSeen) : kSeen);
    };
    if (character.meshes.empty() || !std::all_of(character.meshes.begin(), character.meshes.end(), isUnseen)) return;
    for (Material& material : character.materials) {
        material.alphaMode = Material::AlphaMode::opaque;
        material.baseColor.a = 1.0F;
    }
    character.warnings.emplace_back("all materials of the figure are fully transparent: they were made opaque");
}

void takeFigures(const FigureChoice& choice, const NodeTree& tree, Character& character) {
    for (const SourceFigure& source : choice.figures) {
        FigureInfo figure{source.name, {}, source.vertices};
        for (const int node : source.joints)
            figure.joints.push_back(tree.nodes[node].joint);
        character.figures.push_back(std::move(figure));
    }
    character.figure = static_cast<int>(choice.taken);
}

Error withLocation(Error error, std::string location) {
    error.location = std::move(location);
    return error;
}

// Finite numbers in the file may be no more so once they were scaled and put in their places.
bool hasSoundPlaces(const std::vector<SkinnedMesh>& meshes) {
    for (const SkinnedMesh& mesh : meshes) {
        for (const vec3& position : mesh.positions) {
            if (!isPlace(position)) return false;
        }
    }
    return true;
}

Error tooLarge(const std::string& what, const std::filesystem::path& file) {
    return {ErrorCode::input, fmt::format("its numbers are too large: placed in the scene, {} are beyond any", what),
            file.string(), "scale the figure down where it was made"};
}

}  // namespace

Result<Character> buildCharacter(SourceScene source, const std::filesystem::path& file, const ImportOptions& options) {
    if (std::optional<Error> error = validate(source, file.string())) return *std::move(error);
    cleanNames(source);
    leaveOutHidden(source);
    poseBareSkeleton(source);
    const Result<FigureChoice> figures = chooseFigure(source, options.figure);
    if (!figures) return withLocation(figures.error(), file.string());
    const NodeTree tree = makeNodeTree(source);
    Character character;
    takeFigures(figures.value(), tree, character);
    character.name = withoutControls(file.stem().string(), '_');
    character.file = file;
    character.warnings = std::move(source.warnings);
    character.skeleton.names = tree.jointNames;
    character.skeleton.parents = tree.jointParents;
    character.skeleton.skinWeight.assign(tree.nodeOfJoint.size(), 0.0F);

    const std::vector<MeshInstance> instances = bindMeshes(source, tree, character.warnings);
    std::vector<dmat4> bind = solveBindPose(tree, instances);
    character.meshes = convertMeshes(tree, instances, bind, character.skeleton.skinWeight, character.warnings);
    turnOutwards(character.meshes, character.warnings);
    const FigurePoints figure = pointsOfFigure(character, bind);
    const UnitsAndAxes units =
        settleUnits(source.convention, figure.points, subjectOf(tree.jointNames), options, character.warnings);
    character.units = units.info;
    bringAlong(units, character.skeleton, figure, bind);
    settleMeshes(units, character.meshes);
    for (SkinnedMesh& mesh : character.meshes)
        orderForSkinning(mesh);
    if (!hasSoundPlaces(character.meshes)) return tooLarge("vertices", file);
    takeMaterials(source, character);
    showUnseen(character);
    for (const auto& [role, node] : source.vrmHumanoid)
        character.vrmHumanoid[role] = tree.nodes[node].joint;
    buildMotion(source, tree, bind, units, character);
    if (!validate(character.skeleton).empty()) return tooLarge("joints", file);
    if (const auto against = contradictionIn(character.vrmHumanoid, character.skeleton)) {
        character.warnings.push_back(
            fmt::format("the file's own humanoid map is not believed, for the figure speaks against it: {}", *against));
        character.vrmHumanoid.clear();
    }
    return character;
}

}  // namespace lutka::animation::rig_import
