// The counts of Micropolis on its own scenes, by the classical mode: Weber's thesis, table 7.2, and the original program.
#include "split_rig.h"

#include "formats/mscene.h"
#include "tessera/renderer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>

namespace tessera {
namespace {

// A scene's row in the table; 0 where the table says nothing.
struct Row {
    std::string scene;
    std::uint64_t processed;
    std::uint64_t diced;
    std::uint64_t breadthPeak;
    std::uint64_t bounded10000Peak;  // with the lazy feed (DESIGN.md)
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.scene; }

class Counts : public ::testing::TestWithParam<Row> {
protected:
    void SetUp() override {
        const std::filesystem::path file = std::filesystem::path(TESSERA_SHARED_SCENES) / (GetParam().scene + ".mscene");
        if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file.string() << ": the scenes are not part of this repository";
        const Scene scene = readMscene(file);
        camera_ = scene.cameras.at(0);
        RendererSettings settings;
        settings.cacheFolder = splitting::kernelCache().string();
        renderer_.emplace(settings);
        renderer_->setScene(scene);
    }

    [[nodiscard]] Statistics draw(SplitMethod method, std::uint32_t batch) {
        RenderOptions options;
        options.mode = DiceMode::classical;
        options.width = 1280;
        options.height = 720;
        options.pixelSamples = 1;
        options.splitBound = 8.0F;
        options.diceRate = 8;
        options.maxDepth = 23;
        options.method = method;
        options.batch = batch;
        return renderer_->render(camera_, options).statistics;
    }

private:
    Camera camera_;
    std::optional<Renderer> renderer_;
};

TEST_P(Counts, OfBreadthAreThoseOfTheTable) {
    const Statistics statistics = draw(SplitMethod::breadth, 40000);
    EXPECT_EQ(statistics.rangesProcessed, GetParam().processed);
    EXPECT_EQ(statistics.rangesDiced, GetParam().diced);
    if (GetParam().breadthPeak != 0) {
        EXPECT_EQ(statistics.stackPeak, GetParam().breadthPeak);
    }
}

TEST_P(Counts, OfBoundedAreThoseOfTheTableWithAnyBatch) {
    for (const std::uint32_t batch : {1000U, 10000U, 40000U}) {
        SCOPED_TRACE("batch " + std::to_string(batch));
        const Statistics statistics = draw(SplitMethod::bounded, batch);
        EXPECT_EQ(statistics.rangesProcessed, GetParam().processed);
        EXPECT_EQ(statistics.rangesDiced, GetParam().diced);
        EXPECT_LE(statistics.stackPeak, 24 * std::uint64_t{batch});
        if (batch == 10000 && GetParam().bounded10000Peak != 0) {
            EXPECT_EQ(statistics.stackPeak, GetParam().bounded10000Peak);
        }
    }
}

TEST_P(Counts, OfTheHostAreThoseOfTheTable) {
    const Statistics statistics = draw(SplitMethod::cpu, 40000);
    EXPECT_EQ(statistics.rangesProcessed, GetParam().processed);
    EXPECT_EQ(statistics.rangesDiced, GetParam().diced);
}

INSTANTIATE_TEST_SUITE_P(MicropolisScenes, Counts,
                         ::testing::Values(Row{"teapot", 22172, 11102, 5030, 0}, Row{"hair", 430958, 220479, 150958, 0},
                                           Row{"columns", 293178, 151955, 38712, 20438}, Row{"killeroo", 29038, 20285, 0, 0}),
                         [](const auto& row) { return row.param.scene; });

}  // namespace
}  // namespace tessera
