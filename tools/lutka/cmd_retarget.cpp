#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "animation/clip_reference.hpp"
#include "animation/humanoid/map_humanoid.hpp"
#include "animation/retarget/retarget_clip.hpp"
#include "clip_output.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace lutka::cli {
namespace {

using animation::MeanAndMost;
using animation::RetargetFigures;
using Json = nlohmann::ordered_json;

struct RetargetCommandOptions {
    ModelOptions from;
    std::filesystem::path to;
    std::string clip;
    std::filesystem::path out;
    bool json = false;
    bool looseFeet = false;
    bool allKeys = false;
};

const animation::Clip& clipOf(const animation::Character& character, const std::string& name) {
    if (name.empty() && character.clips.size() == 1) return character.clips.front();
    if (const int clip = animation::clipMeant(character.clips, name); clip >= 0) return character.clips[clip];
    if (name.empty())
        leave({ErrorCode::usage, fmt::format("has {} clips", character.clips.size()), character.file.string(),
               character.clips.empty() ? "take a file with a clip"
                                       : "--clip takes one of " + animation::clipReferences(character.clips)});
    const animation::ClipDoubt doubt = animation::clipDoubt(character.clips, name);
    leave({ErrorCode::usage, doubt.message, character.file.string(), doubt.mend});
}

Json pairJson(const MeanAndMost& figure) {
    return {{"mean", figure.mean}, {"max", figure.most}};
}

Json figuresJson(const RetargetCommandOptions& options, const animation::Clip& clip, const RetargetFigures& figures) {
    Json directions = Json::object();
    for (const animation::DirectionError& error : figures.directions)
        directions[error.part] = pairJson(error.degrees);
    Json json;
    json["source"] = options.from.model.string();
    json["target"] = options.to.string();
    json["clip"] = clip.name;
    json["seconds"] = clip.seconds();
    json["frames"] = clip.frameCount;
    json["scale"] = figures.scale;
    json["limbDirectionDeg"] = {{"mean", figures.meanLimbDeg()}, {"max", figures.mostLimbDeg()}};
    json["directionDeg"] = std::move(directions);
    json["contacts"] = figures.contacts;
    json["footSlideCm"] = pairJson(figures.slideCm);
    json["sourceFootSlideCm"] = pairJson(figures.sourceSlideCm);
    json["floorPenetrationCm"] = pairJson(figures.penetrationCm);
    json["sourceFloorPenetrationCm"] = pairJson(figures.sourcePenetrationCm);
    return json;
}

void printFigures(const animation::Clip& clip, const RetargetFigures& figures) {
    tell("clip '{}', {:.2f} s in {} frames, {:.3f} target metres a source metre\n", clip.name, clip.seconds(),
         clip.frameCount, figures.scale);
    tell("  limbs point off    {:7.2f} deg in the mean, {:.2f} deg at most\n", figures.meanLimbDeg(),
         figures.mostLimbDeg());
    for (const animation::DirectionError& error : figures.directions)
        tell("    {:<17}{:7.2f} deg, {:.2f} deg at most\n", error.part, error.degrees.mean, error.degrees.most);
    tell(
        "  feet slide         {:7.2f} cm in the mean of {} contacts, {:.2f} cm at most (the source's {:.2f}, {:.2f})\n",
        figures.slideCm.mean, figures.contacts, figures.slideCm.most, figures.sourceSlideCm.mean,
        figures.sourceSlideCm.most);
    tell("  soles in the floor {:7.2f} cm in the mean, {:.2f} cm at most\n", figures.penetrationCm.mean,
         figures.penetrationCm.most);
}

void runRetarget(RetargetCommandOptions& options) {
    checkEnding("--output", options.out, {".glb", ".bvh"});
    keepInputs(options.out, {options.from.model, options.to});
    const animation::Character source = orLeave(animation::importCharacter(options.from.model, options.from.import()));
    const animation::Clip& clip = clipOf(source, options.clip);
    ModelOptions targetOptions = options.from;
    targetOptions.model = options.to;
    targetOptions.scale.reset();
    targetOptions.up.clear();
    targetOptions.textures = !isMotionAlone(options.out);  // which has no skin for them
    const animation::Character target = orLeave(animation::importCharacter(options.to, targetOptions.import()));
    const animation::HumanoidMap sourceMap = animation::mapHumanoid(source);
    const animation::HumanoidMap targetMap = animation::mapHumanoid(target);
    if (!options.json) {
        printWarnings(source);
        printWarnings(target);
    }
    auto retargeter = orLeave(animation::Retargeter::make(source, sourceMap, target, targetMap));
    animation::RetargetOptions how;
    how.keepFeet = !options.looseFeet;
    const animation::RetargetedClip made = orLeave(animation::retargetClip(retargeter, clip, how));
    writeClip(options.out, target, made.clip, {}, options.allKeys);
    if (options.json && !isStandardOutput(options.out)) {
        fmt::print("{}\n",
                   figuresJson(options, clip, made.figures).dump(2, ' ', false, Json::error_handler_t::replace));
        return;
    }
    if (isStandardOutput(options.out)) return;
    printFigures(clip, made.figures);
    tell("  wrote {}\n", options.out.string());
}

}  // namespace

void addRetarget(const Command& app) {
    auto options = std::make_shared<RetargetCommandOptions>();
    const Command command = app.add("retarget", "Take a clip of one character to another");
    options->from.addTo(command);
    command.find("MODEL").describe("file with the clip: a rigged character or motion capture");
    command.option("--to", options->to, "the character that the clip is for").required();
    command.option("--clip", options->clip, "the clip: NAME or #NUMBER; default: the file's only one");
    command
        .option("-o,--output", options->out,
                "the character with the clip (.glb), or its joints' motion alone (.bvh); - for a .glb on stdout")
        .required();
    command.flag("--loose-feet", options->looseFeet, "leave the feet where the legs' turns bring them");
    command.flag(
        "--no-reduce", options->allKeys,
        "keep every key of a .glb (a .bvh has all); else those are left out without which no joint is off by 0.1 mm "
        "or 0.05 degrees");
    command.flag("--json", options->json, "print the figures as JSON on stdout");
    command.onRun([options] { runRetarget(*options); });
}

}  // namespace lutka::cli
