// Ogre's files in XML, made here.

#include <fstream>
#include <string>

#include "animation/import/assimp/ogre_material.hpp"
#include "animation/import/gltf_file.hpp"
#include "animation/import/import_character.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;
using rig_import::tidyOgreMaterial;

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

// A triangle whose last corner hangs on a bone above the first.
void writeFigure(const test::TemporaryFolder& folder, const std::string& material) {
    write(folder / "figure.material", material);
    write(folder / "figure.mesh.xml", R"(<mesh><submeshes>
<submesh material="skin" usesharedvertices="false" use32bitindexes="false" operationtype="triangle_list">
<faces count="1"><face v1="0" v2="1" v3="2"/></faces>
<geometry vertexcount="3"><vertexbuffer positions="true" normals="true">
<vertex><position x="0" y="0" z="0"/><normal x="0" y="0" z="1"/></vertex>
<vertex><position x="1" y="0" z="0"/><normal x="0" y="0" z="1"/></vertex>
<vertex><position x="0" y="2" z="0"/><normal x="0" y="0" z="1"/></vertex>
</vertexbuffer></geometry>
<boneassignments><vertexboneassignment vertexindex="0" boneindex="0" weight="1"/>
<vertexboneassignment vertexindex="1" boneindex="0" weight="1"/>
<vertexboneassignment vertexindex="2" boneindex="1" weight="1"/></boneassignments>
</submesh></submeshes><skeletonlink name="figure.skeleton"/></mesh>)");
    write(folder / "figure.skeleton.xml", R"(<skeleton><bones>
<bone id="0" name="Low"><position x="0" y="0" z="0"/><rotation angle="0"><axis x="1" y="0" z="0"/></rotation></bone>
<bone id="1" name="High"><position x="0" y="1" z="0"/><rotation angle="0"><axis x="1" y="0" z="0"/></rotation></bone>
</bones><bonehierarchy><boneparent bone="High" parent="Low"/></bonehierarchy></skeleton>)");
}

}  // namespace

// Assimp 5.2.5 waited for the numbers, and for the ends of blocks, for ever.
TEST_CASE("a material of Ogre that takes its colour from the vertices, or is cut off, ends the reading of no model") {
    for (const std::string material :
         {"material skin\n{\n technique\n {\n  pass\n  {\n   diffuse vertexcolour\n   ambient 1 0 0\n  }\n }\n}\n",
          "material skin\n{\n technique\n {\n  pass\n  {\n   specular 1 0.5\n   texture_unit\n   {\n    texture "
          "a.png\n",
          "material skin\n{\n technique\n {\n  pass\n  {\n   texture_unit\n   {\n    tex_coord_set x\n   }\n  }\n "
          "}\n}\n",
          "material skin\n{\n", "material skin"}) {
        CAPTURE(material);
        const test::TemporaryFolder folder;
        writeFigure(folder, material);
        const Result<Character> read = importCharacter((folder / "figure.mesh.xml").string());
        REQUIRE(read.ok());
        CHECK(read.value().skeleton.names.size() >= 2);
        // The skeleton was looked for in the working directory, too.
        for (const std::string& warning : read.value().warnings)
            CHECK(warning.find("outside") == std::string::npos);
    }
}

TEST_CASE("a material of Ogre keeps what is sound") {
    const std::string text = "material skin\n{\n ambient 0.5 0.5 0.5\n diffuse vertexcolour\n}\n";
    const std::string tidied = tidyOgreMaterial(text);
    CHECK(tidied.find("ambient 0.5 0.5 0.5") != std::string::npos);
    CHECK(tidied.find("diffuse") == std::string::npos);
}
