// The scenes of the evaluation: a name a scene, and which of them stand for the papers' own.
#include "evaluation/evaluation_scenes.h"

#include "evaluation/generated_scenes.h"

#include <algorithm>
#include <utility>

namespace tessera::bench {

namespace {

const char* const kCity = "city";

bool has(const std::vector<SceneSource>& sources, const std::string& scene) {
    return std::any_of(sources.begin(), sources.end(), [&](const SceneSource& source) { return source.name == scene; });
}

// A generated scene under a name that no file has.
SceneSource generatedSource(const std::string& sceneName, const std::string& kind, int count) {
    return {sceneName, [kind, count] { return generated(kind, count); }};
}

void addCityViews(std::vector<View>& views) {
    for (const char* const camera : {"average", "spike", "eyesplit"}) views.push_back({kCity, camera});
}

}  // namespace

GeneratedCounts quickCounts() {
    GeneratedCounts counts;
    counts.city = 20000;
    counts.hair = 200;
    counts.columns = 2;
    counts.random = {1, 4, 16};
    return counts;
}

EvaluationScenes evaluationScenes(const std::string& folder, const GeneratedCounts& counts) {
    EvaluationScenes scenes;
    scenes.sources = fileScenes(folder);
    const auto either = [files = scenes.sources](const std::string& file, const std::string& made) {
        return has(files, file) ? file : made;
    };
    scenes.sources.push_back({"made_teapot", [] { return builtinScene("teapot"); }});
    scenes.sources.push_back(generatedSource("made_hair", "hair", counts.hair));
    scenes.sources.push_back(generatedSource("made_columns", "columns", counts.columns));
    scenes.sources.push_back(generatedSource("made_eyesplit", "eyesplit", 1));
    for (const SceneSource& source : scenes.sources) scenes.table.push_back({source.name, ""});
    addCityViews(scenes.table);
    for (const int count : counts.random) {
        scenes.random.push_back("random_" + std::to_string(count));
        scenes.sources.push_back(generatedSource(scenes.random.back(), "random", count));
    }
    scenes.sources.push_back(generatedSource(kCity, "city", counts.city));
    scenes.city = kCity;
    scenes.teapot = either("teapot", "made_teapot");
    scenes.creature = either("killeroo", "made_teapot");
    scenes.principal = {
        {scenes.teapot, ""}, {either("hair", "made_hair"), ""}, {either("columns", "made_columns"), ""}, {"made_eyesplit", ""}};
    addCityViews(scenes.principal);
    scenes.deep = {{"made_hair", ""}};
    if (has(scenes.sources, "hair")) scenes.deep.push_back({"hair", ""});
    addCityViews(scenes.deep);
    return scenes;
}

}  // namespace tessera::bench
