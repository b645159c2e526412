// Which of a Collada document's animations are one clip.

#include <string>

#include "animation/import/assimp/collada_clips.hpp"
#include "animation/import/assimp/collada_ids.hpp"
#include "support/catch.hpp"

using namespace lutka;
using namespace lutka::animation;

namespace {

std::string animationOf(const std::string& id, const std::string& target) {
    return "<animation id=\"" + id + "\"><source/><channel source=\"#" + id + "\" target=\"" + target +
           "\"/></animation>";
}

std::string contentOf(const std::string& id, const std::string& target) {
    return "<source/><channel source=\"#" + id + "\" target=\"" + target + "\"/>";
}

std::string clipOf(const std::string& attributes, const std::string& first, const std::string& second) {
    return "<animation_clip " + attributes + "><instance_animation url=\"#" + first +
           "\"/><instance_animation url=\"#" + second + "\"/></animation_clip>";
}

const std::string kLibrary = "<library_animations>";
const std::string kEnd = "</library_animations>";

}  // namespace

TEST_CASE("the animations of a Collada clip become one that bears its name") {
    const std::string joints = animationOf("a", "low/t") + animationOf("b", "high/t") + animationOf("c", "low/t") +
                               "<animation id=\"d\">" + animationOf("e", "high/t") + "</animation>";
    const std::string gathered = rig_import::gatheredCollada(
        kLibrary + joints + kEnd + "<library_animation_clips>" + clipOf("name=\"walk\"", "a", "b") +
        clipOf("id=\"run\"", "c", "d") + "</library_animation_clips><scene/>");
    CHECK(gathered == kLibrary + "<animation name=\"walk\">" + contentOf("a", "low/t") + contentOf("b", "high/t") +
                          "</animation><animation name=\"run\">" + contentOf("c", "low/t") + contentOf("e", "high/t") +
                          "</animation>" + kEnd + "<scene/>");
}

TEST_CASE("Collada clips that are parts of one time line leave that time line") {
    const std::string joints = animationOf("a", "low/t") + animationOf("b", "high/t");
    const std::string clips = "<library_animation_clips>" + clipOf("name=\"walk\"", "a", "b") +
                              clipOf("name=\"run\"", "a", "b") + "</library_animation_clips>";
    CHECK(rig_import::gatheredCollada(kLibrary + joints + kEnd + clips) ==
          kLibrary + "<animation>" + contentOf("a", "low/t") + contentOf("b", "high/t") + "</animation>" + kEnd);
}

TEST_CASE("Collada animations of different joints and angles play together, those of one thing stay apart") {
    const std::string first = animationOf("a", "low/rx.ANGLE");
    const std::string second = animationOf("b", "low/ry.ANGLE");
    CHECK(rig_import::gatheredCollada(kLibrary + first + second + kEnd) ==
          kLibrary + "<animation>" + contentOf("a", "low/rx.ANGLE") + contentOf("b", "low/ry.ANGLE") + "</animation>" +
              kEnd);
    // The name that all of them have, or those of them that have any.
    std::string named = second;
    named.insert(named.find(" id"), " name=\"walk\"");
    CHECK(rig_import::gatheredCollada(kLibrary + first + named + kEnd)
              .starts_with(kLibrary + "<animation name=\"walk\">"));
    for (const std::string& text :
         {kLibrary + first + animationOf("c", "low/rx.ANGLE") + kEnd, kLibrary + first + kEnd,
          kLibrary + "<animation><channel/>", std::string("<animation_clip><channel/>"), std::string("<channel")})
        CHECK(rig_import::gatheredCollada(text) == text);
}

TEST_CASE("Collada animations of several libraries stay apart") {
    const std::string first = animationOf("a", "low/t");
    const std::string second = animationOf("b", "high/t");
    const std::string apart = kLibrary + first + kEnd + kLibrary + second + kEnd;
    CHECK(rig_import::gatheredCollada(apart) == apart);
    const std::string one =
        kLibrary + "<animation>" + contentOf("a", "low/t") + contentOf("b", "high/t") + "</animation>" + kEnd;
    CHECK(rig_import::gatheredCollada("<library_animations/>" + kLibrary + first + second + kEnd) ==
          "<library_animations/>" + one);
}

TEST_CASE("Collada animations that call their samplers and sources alike have them for themselves") {
    // As an exporter writes them that knows no other names.
    const auto sampled = [](const std::string& target, const std::string& suffix) {
        return "<animation><source id=\"in" + suffix + "\"><float_array id=\"ina" + suffix +
               "\">0 1</float_array><accessor source=\"#ina" + suffix + "\"/></source><sampler id=\"s" + suffix +
               "\"><input semantic=\"INPUT\" source=\"#in" + suffix + "\"/></sampler><channel source=\"#s" + suffix +
               "\" target=\"" + target + "\"/></animation>";
    };
    const std::string alike = kLibrary + sampled("low/t", "") + sampled("high/t", "") + kEnd;
    const std::string own = rig_import::withOwnIds(alike);
    CHECK(own.starts_with(kLibrary + sampled("low/t", "") + "<animation><source id=\"in-1\">"));
    CHECK(own.find("<accessor source=\"#ina-2\"/>") != std::string::npos);
    CHECK(own.find("<input semantic=\"INPUT\" source=\"#in-1\"/>") != std::string::npos);
    CHECK(own.find("<channel source=\"#s-3\" target=\"high/t\"/>") != std::string::npos);
    CHECK(rig_import::withOwnIds(own) == own);
    // An id that is free, though the next would be another's; and one of the geometry's, which stays the geometry's.
    CHECK(rig_import::withOwnIds("<source id=\"s\"/>" + kLibrary + sampled("low/t", "") + "<animation id=\"s-1\"/>" +
                                 kEnd)
              .find("<channel source=\"#s-2\" target") != std::string::npos);
    // What an animation does not have itself it means of the one around it.
    const std::string nested = kLibrary + "<animation><source id=\"in\"/></animation><animation><source id=\"in\"/>" +
                               "<animation><sampler id=\"s\"><input source=\"#in\"/><input source=\"#no\"/></sampler>" +
                               "</animation></animation>" + kEnd;
    CHECK(rig_import::withOwnIds(nested).find("<input source=\"#in-1\"/><input source=\"#no\"/>") != std::string::npos);
    CHECK(rig_import::withOwnIds("</animation><source id=\"x\"/>") == "</animation><source id=\"x\"/>");
}

TEST_CASE("Collada animations that are nested deep have their ids settled one by one") {
    std::string nested = kLibrary;
    std::string settled = kLibrary;
    std::string ends;
    constexpr int kDepth = 100'000;
    for (int i = 0; i < kDepth; ++i) {
        const std::string links = "<input source=\"#s\"/><input source=\"#no\"/>";
        nested += "<animation>" + links;
        settled += "<animation>" + links;
        if (i == 0) nested += "<source id=\"s\"/>";
        if (i == 0) settled += "<source id=\"s\"/>";
        ends += "</animation>";
    }
    // Once more in the innermost, and after it again what the outermost has.
    const std::string link = "<input source=\"#s\"/>";
    const std::string last = "</animation>" + link + ends.substr(12) + kEnd;
    CHECK(rig_import::withOwnIds(nested + "<source id=\"s\"/>" + link + last) ==
          settled + "<source id=\"s-1\"/><input source=\"#s-1\"/>" + last);
}

TEST_CASE("Collada clips go to the library that holds animations, not to an empty one before it") {
    const std::string library =
        "<library_animations/>" + kLibrary + animationOf("a", "low/t") + animationOf("b", "high/t") + kEnd;
    const std::string clips =
        "<library_animation_clips>" + clipOf("name=\"walk\"", "a", "b") + "</library_animation_clips>";
    CHECK(rig_import::gatheredCollada(library + clips) == "<library_animations/>" + kLibrary +
                                                              "<animation name=\"walk\">" + contentOf("a", "low/t") +
                                                              contentOf("b", "high/t") + "</animation>" + kEnd);
}

TEST_CASE("Collada animations that are nested deep are gathered once") {
    std::string nested = kLibrary;
    std::string clip = "<animation_clip name=\"walk\">";
    std::string ends;
    constexpr int kDepth = 30'000;
    for (int i = 0; i < kDepth; ++i) {
        nested += "<animation id=\"" + std::to_string(i) + "\">";
        clip.insert(clip.find('>') + 1, "<instance_animation url=\"#" + std::to_string(i) + "\"/>");
        ends += "</animation>";
    }
    nested += contentOf("a", "low/t") + ends + kEnd;
    const std::string library = kLibrary + "<animation>" + contentOf("a", "low/t") + "</animation>" + kEnd;
    CHECK(rig_import::gatheredCollada(nested) == library);
    std::string named = library;
    named.insert(named.find("><source"), " name=\"walk\"");
    CHECK(rig_import::gatheredCollada(nested + "<library_animation_clips>" + clip +
                                      "</animation_clip></library_animation_clips>") == named);
}

TEST_CASE("what Assimp adds to the names of Collada clips is taken away") {
    rig_import::SourceScene scene;
    for (const char* name : {"walk_walk", "walk_run", "walk_other"}) {
        scene.clips.emplace_back();
        scene.clips.back().name = name;
    }
    const std::string document = "<animation_clip name=\"walk\"/><animation_clip name=\"run\"/>";
    rig_import::settleColladaClips(rig_import::ColladaDocument(document), scene);
    CHECK(scene.clips[0].name == "walk");
    CHECK(scene.clips[1].name == "run");
    CHECK(scene.clips[2].name == "walk_other");
    scene.clips[0].name = "animation_animation";
    rig_import::settleColladaClips(rig_import::ColladaDocument(""), scene);
    CHECK(scene.clips[0].name == "animation");
    CHECK(scene.clips[2].name == "walk_other");
}
