// `tessera generate`: files that read back as the scenes they are, complete or not at all.
#include "program_fixture.h"
#include "tessera/generate.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace tessera::test {

namespace {

using nlohmann::json;

class ProgramGenerates : public Program {
protected:
    [[nodiscard]] Outcome generate(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "generate");
        return run(arguments);
    }
};

TEST_F(ProgramGenerates, HelpTellsEveryOptionAndEachScenesRange) {
    const Outcome outcome = run({"generate", "--help"});
    expectSuccess(outcome);
    for (const std::string option : {"--output", "--count", "--seed", "--quiet", "--help"}) {
        EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
    }
    for (const GeneratedScene& scene : generatedScenes()) {
        EXPECT_NE(outcome.out.find(scene.contents), std::string::npos) << scene.name;
        EXPECT_NE(outcome.out.find(std::to_string(scene.least) + " to " + std::to_string(scene.most)), std::string::npos) << scene.name;
    }
    EXPECT_NE(run({"--help"}).out.find("generate"), std::string::npos);
}

TEST_F(ProgramGenerates, FilesThatReadBackAsTheScenesTheyAre) {
    for (const GeneratedScene& about : generatedScenes()) {
        const std::uint64_t count = std::max<std::uint64_t>(about.least, std::min<std::uint64_t>(about.most, 50));
        const std::string name(about.name);
        const std::string file = name + ".mscene";
        expectSuccess(generate({name, "--count", std::to_string(count), "--seed", "3", "-o", file}));
        std::vector<std::string> warnings;
        const Scene read = readMscene(folder_.path() / file, &warnings);
        EXPECT_TRUE(warnings.empty()) << name;
        const Scene made = generateScene(name, count, 3);
        EXPECT_EQ(serializeMscene(read), serializeMscene(made)) << name;
        EXPECT_EQ(read.placedPatchCount(), made.placedPatchCount()) << name;
    }
}

TEST_F(ProgramGenerates, SummaryUnlessQuietAndAnOlderFileReplaced) {
    const Outcome told = generate({"random", "--count", "20", "-o", "k.mscene"});
    expectSuccess(told);
    EXPECT_NE(told.err.find("random: 20 patches in 8 objects"), std::string::npos) << told.err;
    EXPECT_EQ(told.out, "");
    const std::string first = file("k.mscene");
    const Outcome quiet = generate({"random", "--count", "20", "--seed", "0", "--quiet", "-o", "k.mscene"});
    expectSuccess(quiet);
    EXPECT_EQ(quiet.err + quiet.out, "");
    EXPECT_NE(file("k.mscene"), first);
    EXPECT_EQ(folder_.fileNames(), std::set<std::string>{"k.mscene"});
}

TEST_F(ProgramGenerates, CityIsRenderedThroughEachOfItsCameras) {
    expectSuccess(generate({"city", "--count", "20000", "-o", "city.mscene"}));
    for (const std::string camera : {"average", "spike", "eyesplit"}) {
        const Outcome outcome =
            run({"render", "city.mscene", "--camera", camera, "-o", "k.png", "--size", "64x36", "--pixel-samples", "1", "--stats", "-"});
        expectSuccess(outcome);
        const json stats = json::parse(outcome.out);
        // So small a city has one willow, and sky behind it.
        EXPECT_GT(stats.at("pixels_covered").get<int>(), 64 * 36 / 8) << camera;
    }
}

class ProgramGenerateRefuses : public ProgramGenerates, public testing::WithParamInterface<BadInput> {};

TEST_P(ProgramGenerateRefuses, WithOneLineAndNoFile) {
    const Outcome outcome = generate(GetParam().arguments);
    expectRefused(outcome, GetParam());
    EXPECT_TRUE(folder_.fileNames().empty());
}

INSTANTIATE_TEST_SUITE_P(
    CommandLines, ProgramGenerateRefuses,
    testing::Values(BadInput{"unknown", 1, {"forest", "-o", "k.mscene"}, "hair, columns, city"},
                    BadInput{"noName", 2, {"-o", "k.mscene"}, "NAME"}, BadInput{"noOutput", 2, {"hair"}, "--output"},
                    BadInput{"none", 2, {"hair", "--count", "0", "-o", "k.mscene"}, "1 to 1000000 strands"},
                    BadInput{"negative", 2, {"hair", "--count", "-5", "-o", "k.mscene"}, "--count"},
                    BadInput{"huge", 2, {"random", "--count", "9000000000000000000", "-o", "k.mscene"}, "1 to 4000000 patches"},
                    BadInput{"hugest", 2, {"random", "--count", "99999999999999999999999", "-o", "k.mscene"}, "--count"},
                    BadInput{"smallCity", 2, {"city", "--count", "19999", "-o", "k.mscene"}, "20000 to 20000000 patches"},
                    BadInput{"seed", 2, {"hair", "--seed", "4294967296", "-o", "k.mscene"}, "0 to 4294967295"},
                    BadInput{"seedless", 2, {"hair", "--seed", "x", "-o", "k.mscene"}, "--seed"},
                    BadInput{"ending", 2, {"hair", "-o", "k.obj"}, ".mscene"},
                    BadInput{"nowhere", 1, {"hair", "-o", "none/such/k.mscene"}, "none/such"}),
    [](const testing::TestParamInfo<BadInput>& bad) { return bad.param.name; });

}  // namespace

}  // namespace tessera::test
