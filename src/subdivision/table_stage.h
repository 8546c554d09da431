// All cages of a scene after some more steps of subdivision, and the objects that place them.
#pragma once

#include <cstdint>
#include <vector>

#include "subdivision/clean_cage.h"
#include "subdivision/table_faces.h"
#include "tables/tables_shared.h"
#include "tessera/mesh_sink.h"
#include "tessera/scene.h"

namespace tessera::subdivision {

// A cage of the scene as tables take it.
struct TableCage {
    CleanCage clean;
    int ownSteps = 0;              // 1 where there are faces of other than four corners
    std::uint32_t firstPoint = 0;  // among the points of all cages
};

struct TableStage {
    std::vector<TableFaces> cages;
    std::vector<std::uint32_t> firstFace;   // of each cage
    std::vector<std::uint32_t> firstPoint;  // of each cage among the points of all, after the steps
    std::vector<table_object> objects;      // those that have faces
    std::vector<std::uint32_t> cageOf;      // of each object
    std::uint32_t patches = 0;
    std::uint32_t placedPoints = 0;
    std::uint32_t points = 0;
};

// `more`: steps beyond the cages' own. Throws Error where there are more than 2^32 - 1 of anything.
[[nodiscard]] TableStage makeStage(const Scene& scene, const std::vector<TableCage>& cages, int more, TableStore& store);

// What a sink takes for the scene (weld_keys.h): a Bezier mesh for each object, whose borders' points are numbers that stand for vertices
// and edges, and identity transforms.
[[nodiscard]] Scene standIn(const Scene& scene, const TableStage& stage);
[[nodiscard]] std::vector<MeshPatch> placedPatches(const TableStage& stage);

}  // namespace tessera::subdivision
