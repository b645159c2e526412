#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;
using Json = nlohmann::json;

namespace {

void replaceIn(const std::string& file, const std::string& what, const std::string& with) {
    std::string text = fileText(file);
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    text.replace(at, what.size(), with);
    std::ofstream(file) << text;
}

}  // namespace

TEST_CASE("a run that kept its inputs is simulated again from them and compared") {
    const ScratchFolder folder;
    const std::string inputs = folder / "pile.inputs.json";
    const std::string model = "simulate " + kMannequinArgument;
    REQUIRE(lutkaCommand(model + " --scene pile --count 3 --seed 5 --seconds 1.5 --record " + inputs).code == 0);
    const CommandResult again = lutkaCommand(model + " --threads 2 --replay " + inputs);
    CHECK(again.code == 0);
    CHECK_THAT(again.out, Catch::Contains("90 steps") && Catch::Contains("all 3 checks"));

    const CommandResult other = lutkaCommand(model + " --masses uniform --replay " + inputs);
    CHECK(other.code == 3);
    CHECK_THAT(other.err, Catch::Contains("another profile"));

    replaceIn(inputs, "\"count\"", "\"counted\"");
    CHECK(lutkaCommand(model + " --replay " + inputs).code == 3);
}

TEST_CASE("a run of hulls that kept its inputs is simulated again from them by each solver") {
    const ScratchFolder folder;
    const std::string inputs = folder / "hulls.inputs.json";
    const std::string profile = folder / "hulls.ragdoll.json";
    REQUIRE(lutkaCommand("build " + kMannequinArgument + " --hulls -o " + profile).code == 0);
    const std::string model = "simulate " + kMannequinArgument;
    for (const char* solver : {"crowd", "bullet"}) {
        INFO(solver);
        REQUIRE(lutkaCommand(model + " --hulls --scene stairs --seconds 1 --solver " + solver + " --record " + inputs)
                    .code == 0);
        const CommandResult again = lutkaCommand(model + " --hulls --replay " + inputs);
        INFO(again.err);
        CHECK(again.code == 0);
        CHECK_THAT(again.out, Catch::Contains("60 steps"));
        // A profile brings its hulls along, to the last bit.
        CHECK(lutkaCommand(model + " --profile " + profile + " --replay " + inputs).code == 0);
        const CommandResult other = lutkaCommand(model + " --replay " + inputs);
        CHECK(other.code == 3);
        CHECK_THAT(other.err, Catch::Contains("another profile"));
    }
}

TEST_CASE("a run from inputs that differ ends with the step and the body") {
    const ScratchFolder folder;
    const std::string inputs = folder / "fall.inputs.json";
    const std::string model = "simulate " + kMannequinArgument;
    REQUIRE(lutkaCommand(model + " --solver bullet --seconds 2 --record " + inputs).code == 0);
    replaceIn(inputs, "\"hits\": []",
              R"("hits": [{"step": 70, "doll": 0, "body": 0, "impulse": [0, 0, 5], "at": [0, 0, 0]}])");
    const CommandResult result = lutkaCommand(model + " --replay " + inputs);
    CHECK(result.code == 3);
    CHECK_THAT(result.err, Catch::Contains("after step 120") && Catch::Contains("of doll 1"));
    replaceIn(inputs, "\"step\": 70", "\"step\": 7.5");
    const CommandResult broken = lutkaCommand(model + " --replay " + inputs);
    CHECK(broken.code == 3);
    CHECK_THAT(broken.err, Catch::Contains("/hits/0/step"));
}

TEST_CASE("names with blanks survive the way through a file of inputs") {
    const ScratchFolder folder;
    const std::string profile = folder / "doll.ragdoll.json";
    REQUIRE(lutkaCommand("build " + kMannequinArgument + " -o " + profile).code == 0);
    // A body without a role may have any name.
    std::string text = fileText(profile);
    Json doll = Json::parse(text);
    for (Json& body : doll["bodies"]) {
        if (body["name"] != "leftHand") continue;
        body["name"] = "left \"hand\" of it";
        body.erase("role");
    }
    for (Json& constraint : doll["constraints"]) {
        if (constraint["child"] == "leftHand") constraint["child"] = "left \"hand\" of it";
    }
    std::ofstream(profile) << doll.dump(1);
    const std::string inputs = folder / "walk.inputs.json";
    const std::string model = "simulate " + kMannequinArgument + " --profile " + profile;
    const std::string hand = "'left \"hand\" of it'";
    REQUIRE(lutkaCommand(
                model +
                " --clip walk --puppet powered --hit head@0.2:5 --hit hips@0.3:0,0,4 --seconds 0.5 --kinematic hips," +
                hand + " --record " + inputs)
                .code == 0);
    const CommandResult again = lutkaCommand(model + " --replay " + inputs);
    INFO(again.err);
    CHECK(again.code == 0);
    REQUIRE(lutkaCommand(model + " --hold head," + hand + " --seconds 0.5 --record " + inputs).code == 0);
    const CommandResult held = lutkaCommand(model + " --replay " + inputs);
    INFO(held.err);
    CHECK(held.code == 0);
}
