#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "animation/character.hpp"
#include "animation/import/import_character.hpp"

namespace lutka::animation::rig_import {

/// Translation, rotation and scale in that order from the left: what a channel replaces a part of.
struct SourceTrs {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

/// A node of the file's scene.
struct SourceNode {
    std::string name;                ///< As in the file; neither unique nor always there.
    int parent = -1;                 ///< Index of the parent node, smaller than the node's own; -1 for a root.
    glm::dmat4 parentFromNode{1.0};  ///< The node's own pose.
    /// A node that the reader made up between two of the file's (Assimp's FBX pivots): posed like any other, no joint.
    bool isHelper = false;
    std::optional<SourceTrs> trs = std::nullopt;  ///< The pose's parts, where the file states them.
};

/// A triangle mesh as the file has it, in its own space. Vertex arrays have the size of `positions`, or are empty.
struct SourceMesh {
    /// A vertex's share in a joint of the skin that the mesh is instanced with.
    struct Influence {
        std::uint32_t slot = 0;  ///< Index into SourceSkin::joints.
        float weight = 0.0F;     ///< Not yet normalised.
    };

    std::string name;
    std::vector<vec3> positions;
    std::vector<vec3> normals;           ///< Empty: to be made from the triangles.
    std::vector<vec4> tangents;          ///< w = ±1, the sign of the bitangent; empty: to be made.
    std::vector<vec2> uvs;               ///< glTF convention; the set and transform that the material's pictures use.
    std::vector<vec4> colors;            ///< Linear RGBA, [0, 1].
    std::vector<std::uint32_t> indices;  ///< Three a triangle.
    int material = -1;                   ///< Index into SourceScene::materials; -1: none.

    /// The influences of vertex v are influences[influenceStart[v]] up to influences[influenceStart[v + 1]]: one
    /// element more than there are vertices. Both empty without a skin.
    std::vector<std::uint32_t> influenceStart;
    std::vector<Influence> influences;
};

/// What binds a mesh to joints.
struct SourceSkin {
    struct Joint {
        int node = -1;
        glm::dmat4 jointFromMesh{1.0};  ///< The inverse bind matrix.
    };
    std::vector<Joint> joints;
    /// Where the undeformed mesh stands in the scene, when the file states it (FBX: the clusters' TransformLink times
    /// jointFromMesh). Without it only the joints' own matrices tell, up to a common factor.
    std::optional<glm::dmat4> sceneFromMesh;
    /// The file has no inverse bind matrices: vertices are stored relative to their joints, which stand in the nodes'
    /// pose when the mesh is undeformed.
    bool verticesAreInJoints = false;
};

/// A mesh where it hangs in the scene. A mesh may be instanced several times, with different skins too.
struct SourceInstance {
    int mesh = -1;
    int node = -1;
    int skin = -1;        ///< -1: carried rigidly by its node. Else the skin has a slot for each influence of the mesh.
    bool hidden = false;  ///< The file does not show it.
};

/// Key frames of one property of one node.
struct SourceChannel {
    enum class Path { translation, rotation, scale };
    enum class Interpolation { step, linear, cubicSpline };

    int node = -1;
    Path path = Path::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> times;  ///< Seconds, ascending.
    /// Three numbers a key, four (x y z w) for rotations. With cubicSpline each key has in-tangent, value, out-tangent,
    /// as in glTF.
    std::vector<float> values;
};

struct SourceClip {
    std::string name;
    std::vector<SourceChannel> channels;  ///< A property without a channel keeps the node's own pose.
};

/// What the file says of its unit and axes. Unset: it says nothing.
struct SourceConvention {
    std::optional<double> metresPerUnit;  ///< > 0.
    std::string unitSource;               ///< For UnitInfo: "glTF", "FBX UnitScaleFactor" …
    std::optional<UpAxis> up;
    std::string upSource;
};

/// A file's scene as plain data: what every reader gives and the rest of import works on. Nothing is settled yet: scene
/// space, the file's unit and axes, any scale and shear. It is also what crosses from the importing process.
struct SourceScene {
    std::string format;             ///< For people: "glTF 2.0", "FBX 7.4 binary" …
    std::vector<SourceNode> nodes;  ///< Parents before children, in file order.
    std::vector<SourceMesh> meshes;
    std::vector<SourceSkin> skins;
    std::vector<SourceInstance> instances;
    std::vector<SourceClip> clips;
    std::vector<Material> materials;
    std::vector<Texture> textures;  ///< Decoded; empty when pictures were not asked for.
    SourceConvention convention;
    bool nodesArePosed = true;  ///< False when the reader lost the hierarchy: only the skins' matrices count.
    std::map<std::string, int> vrmHumanoid;  ///< VRM 1.0 role name → node, from the file's own humanoid block.
    std::vector<std::string> warnings;       ///< What was left out or repaired in reading, a sentence each.
};

}  // namespace lutka::animation::rig_import
