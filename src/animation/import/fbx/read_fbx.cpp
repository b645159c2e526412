#include "animation/import/fbx/read_fbx.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "animation/import/fbx/blend_shapes.hpp"
#include "animation/import/fbx/clips.hpp"
#include "animation/import/fbx/conventions.hpp"
#include "animation/import/fbx/material.hpp"
#include "animation/import/fbx/mesh_geometry.hpp"
#include "animation/import/fbx/model_tree.hpp"
#include "animation/import/fbx/motion.hpp"
#include "animation/import/fbx/skin.hpp"
#include "animation/import/source_limits.hpp"
#include "animation/import/texture_loader.hpp"
#include "core/files.hpp"

namespace lutka::animation::rig_import {
namespace {

using namespace fbx;

// Builds the scene of one document, part by part.
class SceneReader {
  public:
    SceneReader(const Document& document, PictureLoader load)
        : document_(document), objects_(document), materials_(document, objects_, std::move(load)) {}

    std::optional<Error> read(const std::string& location) {
        Result<ModelTree> tree = readModelTree(objects_, location);
        if (!tree) return tree.error();
        tree_ = std::move(tree).value();
        scene_.format = fmt::format("FBX {}.{} {}", document_.version / 1000, document_.version / 100 % 10,
                                    document_.binary ? "binary" : "ASCII");
        const std::vector<Motion> motions = readMotions(document_, objects_, tree_.nodeOfModel);
        layout_ = layoutOf(tree_, motions);
        modelOfNode_.assign(tree_.parents.size(), -1);
        for (const auto& [model, node] : tree_.inOrder)
            modelOfNode_[static_cast<std::size_t>(node)] = model;
        readNodes();
        readMeshes();
        scene_.clips = sampleMotions(motions, tree_, layout_, frameRateOf(objects_.settings()), scene_.warnings);
        movesBlendShapes_ = movesBlendShapes(document_, objects_);
        if (movesBlendShapes_) scene_.warnings.emplace_back("animations of blend shapes were left out");
        tellUnread();
        return std::nullopt;
    }

    SourceScene take() { return std::move(scene_); }

  private:
    [[nodiscard]] bool hangsOnModel(const Object& object) const {
        const auto index = static_cast<int>(&object - objects_.all().data());
        const auto parents = objects_.parentsOf(index);
        return std::any_of(parents.begin(), parents.end(), [&](const Connection& link) {
            return link.parent != Objects::kRoot && objects_[link.parent].kind == "Model";
        });
    }

    // Surfaces and deformers that have no triangles and joints.
    void tellUnread() {
        std::set<std::string> unread;
        const bool plays = std::any_of(scene_.clips.begin(), scene_.clips.end(),
                                       [](const SourceClip& clip) { return !clip.channels.empty(); });
        for (const Object& object : objects_.all()) {
            const std::string_view kind = object.subKind;
            const bool curved =
                kind == "NurbsSurface" || kind == "TrimNurbsSurface" || kind == "Nurb" || kind == "Patch";
            if (curved && object.kind == "Geometry") unread.insert("curved surfaces (NURBS and patches)");
            if (kind == "VertexCacheDeformer") unread.insert("deformation by vertex caches");
            const bool isMesh = object.kind == "Geometry" && kind == "Mesh";
            if (isMesh && !hangsOnModel(object)) unread.insert("meshes that are connected to no node");
            if (object.kind == "AnimationCurve" && !plays && !movesBlendShapes_)
                unread.insert("animations, for none of them moves a node in a stack and layer");
        }
        if (!unread.empty()) scene_.warnings.push_back(fmt::format("left out: {}", fmt::join(unread, "; ")));
    }

    void readNodes() {
        const Conventions conventions = conventionsOf(objects_.settings());
        scene_.convention = conventions.stated;
        std::vector<dmat4> parentFromNode(tree_.parents.size());
        evaluateTree(tree_, tree_.transforms, parentFromNode);
        parentFromNode[0] = conventions.sceneFromFile;
        for (std::size_t i = 0; i < tree_.parents.size(); ++i) {
            const int parent = tree_.parents[i];
            addNode(i, parent, parentFromNode[i]);
            sceneFromNode_.push_back(parent < 0 ? parentFromNode[i]
                                                : sceneFromNode_[static_cast<std::size_t>(parent)] * parentFromNode[i]);
        }
        sceneFromFile_ = conventions.sceneFromFile;
    }

    void addNode(std::size_t node, int parent, const dmat4& parentFromNode) {
        const int above = parent < 0 ? -1 : layout_.sceneNode[static_cast<std::size_t>(parent)];
        if (layout_.helper[node] < 0) {
            push(tree_.names[node], above, parentFromNode, false);
            return;
        }
        const dmat4 helper = parentFromHelper(parentFromNode, tree_.transforms[static_cast<std::size_t>(parent)]);
        push(tree_.names[node] + " without its parent's scale", above, helper, true);
        push(tree_.names[node], layout_.helper[node], glm::inverse(helper) * parentFromNode, false);
    }

    void push(std::string name, int parent, const dmat4& parentFromNode, bool isHelper) {
        SourceNode node;
        node.name = std::move(name);
        node.parent = parent;
        node.parentFromNode = parentFromNode;
        node.isHelper = isHelper;
        scene_.nodes.push_back(std::move(node));
    }

    // The material of that slot of a model, read at its first use; -1 for none.
    int materialAt(std::span<const int> slots, int slot) {
        if (slots.empty()) return -1;
        const int object = slots[std::min(static_cast<std::size_t>(slot), slots.size() - 1)];
        const auto [known, isNew] = materialOf_.try_emplace(object, static_cast<int>(scene_.materials.size()));
        if (isNew) {
            ReadMaterial read = materials_.read(object);
            uvSets_[object] = std::move(read.uvSet);
            scene_.materials.push_back(std::move(read.material));
        }
        return known->second;
    }

    void readMeshes() {
        GeometryRepairs repairs;
        GeometryReader geometries(objects_, repairs);
        const std::map<int, dmat4> bindPose = bindPoseInScene();
        const SkinContext context{objects_, tree_.nodeOfModel, sceneFromNode_, bindPose, sceneFromFile_};
        for (const auto& [model, node] : tree_.inOrder) {
            // FBX 6 keeps the geometry in the model itself.
            std::vector<int> owners = objects_.children(model, "Geometry", "Mesh");
            if (objects_[model].record->child("Vertices") != nullptr) owners.push_back(model);
            for (const int owner : owners)
                addMesh(context, geometries, {owner, model, node});
        }
        for (std::string& sentence : repairs.sentences())
            scene_.warnings.push_back(std::move(sentence));
        if (!materials_.unread().empty()) {
            scene_.warnings.push_back(
                fmt::format("left out: pictures whose property is none for colour, normals or glow: {}",
                            fmt::join(materials_.unread(), ", ")));
        }
        if (!additiveMeshes_.empty())
            scene_.warnings.push_back(fmt::format(
                "joints of these meshes add to the others' motion in the file (additive clusters); read as shares: {}",
                fmt::join(additiveMeshes_, ", ")));
        if (!dualQuaternionMeshes_.empty()) {
            scene_.warnings.push_back(fmt::format(
                "skinned by dual quaternions in the file: {}; files are written, and pictures drawn, with linear "
                "skinning (`lutka render --skinning dual` draws the other)",
                fmt::join(dualQuaternionMeshes_, ", ")));
        }
    }

    struct Place {
        int owner;  // of the geometry
        int model;
        int node;
    };

    void addMesh(const SkinContext& context, GeometryReader& geometries, const Place& place) {
        const std::vector<int> slots = objects_.children(place.model, "Material");
        std::vector<std::string> uvSets;
        for (std::size_t slot = 0; slot < slots.size(); ++slot) {
            (void)materialAt(slots, static_cast<int>(slot));
            uvSets.push_back(uvSets_[slots[slot]]);
        }
        const dmat4 originFromNode = glm::translate(dmat4(1.0), -tree_.origins[static_cast<std::size_t>(place.node)]);
        std::vector<MeshPart> parts =
            geometries.read(place.owner, originFromNode * geometricMatrix(objects_[place.model].properties), uvSets);
        const std::size_t points = objects_[place.owner].record->numbersOf("Vertices").size() / 3;
        const std::optional<ReadSkin> skin =
            parts.empty() ? std::nullopt : readSkin(context, place.owner, place.model, points);
        if (skin) {
            if (skin->isAdditive) additiveMeshes_.insert(objects_[place.model].name);
            if (!skin->isLinear) dualQuaternionMeshes_.insert(objects_[place.model].name);
            scene_.skins.push_back(skin->skin);
            for (SourceSkin::Joint& joint : scene_.skins.back().joints)
                joint.node = layout_.sceneNode[static_cast<std::size_t>(joint.node)];
        }
        for (MeshPart& part : parts) {
            if (skin) weightVertices(*skin, part.controlPoints, part.mesh);
            const std::string& own = objects_[place.owner].name;
            part.mesh.name = own.empty() ? objects_[place.model].name : own;
            part.mesh.material = materialAt(slots, part.slot);
            const int mesh = static_cast<int>(scene_.meshes.size());
            scene_.meshes.push_back(std::move(part.mesh));
            scene_.instances.push_back({mesh, layout_.sceneNode[static_cast<std::size_t>(place.node)],
                                        skin ? static_cast<int>(scene_.skins.size()) - 1 : -1, isHidden(place)});
        }
    }

    // Whether a model is one of the coarser copies in a group of levels of detail, which has the finest first.
    [[nodiscard]] bool isCoarser(int model) const {
        for (const Connection& above : objects_.parentsOf(model)) {
            if (above.parent < 0) continue;
            const bool isGroup = objects_[above.parent].subKind == "LodGroup" ||
                                 !objects_.children(above.parent, "NodeAttribute", "LodGroup").empty();
            if (isGroup) return objects_.children(above.parent, "Model").front() != model;
        }
        return false;
    }

    // Whether a mesh is hidden by itself or by what it hangs on. What the file moves may be seen at another time.
    [[nodiscard]] bool isHidden(const Place& place) const {
        if (objects_[place.model].properties.integer("Show", 1) == 0) return true;
        for (int node = place.node; node >= 0; node = tree_.parents[static_cast<std::size_t>(node)]) {
            const int model = modelOfNode_[static_cast<std::size_t>(node)];
            if (model < 0) break;
            if (isCoarser(model)) return true;
            const Properties& properties = objects_[model].properties;
            const bool moves = objects_.childAt(model, "Visibility", "AnimationCurveNode") >= 0;
            if (properties.number("Visibility", 1.0) <= 0.0 && !moves) return true;
            if (properties.integer("Visibility Inheritance", 1) == 0) break;
        }
        return false;
    }

    std::map<int, dmat4> bindPoseInScene() const {
        std::map<int, dmat4> pose = readBindPose(objects_);
        for (auto& [model, matrix] : pose)
            matrix = sceneFromFile_ * matrix;
        return pose;
    }

    const Document& document_;
    Objects objects_;
    MaterialReader materials_;
    ModelTree tree_;
    SceneLayout layout_;
    bool movesBlendShapes_ = false;
    std::vector<int> modelOfNode_;  // -1: none
    SourceScene scene_;
    std::vector<dmat4> sceneFromNode_;
    dmat4 sceneFromFile_{1.0};
    std::map<int, int> materialOf_;
    std::map<int, std::string> uvSets_;
    std::set<std::string> dualQuaternionMeshes_;
    std::set<std::string> additiveMeshes_;
};

}  // namespace

Result<SourceScene> readFbx(const std::filesystem::path& file, const ImportOptions& options) {
    Result<std::vector<unsigned char>> bytes = readFile(file, kMaxFileBytes);
    if (!bytes) return bytes.error();
    Result<Document> document = parseDocument(std::move(bytes).value(), file.string());
    if (!document) return document.error();
    TextureLoader pictures([](const std::string&, PictureDecoder&) { return std::nullopt; },
                           ModelFolder(file, options.allowOutside), options.loadTextures);
    SceneReader reader(document.value(),
                       [&](const PictureSource& source) { return pictures.load(source.path, source.embedded); });
    if (std::optional<Error> failed = reader.read(file.string())) return *std::move(failed);
    SourceScene scene = reader.take();
    scene.textures = pictures.takeTextures();
    for (std::string& sentence : pictures.sentences())
        scene.warnings.push_back(std::move(sentence));
    return scene;
}

}  // namespace lutka::animation::rig_import
