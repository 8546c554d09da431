// What the generated city is put together from: models of one or more meshes, each to be placed many times.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "scene/generate_numbers.h"
#include "tessera/scene.h"

namespace tessera {

// A mesh of a model, and what it may look like: each placing picks one of the colours.
struct ModelPart {
    std::string mesh;
    std::vector<glm::vec3> colors;
    Material material;
};

// Stands on the origin, y up; lengths are metres.
struct Model {
    std::vector<ModelPart> parts;
    std::size_t patches = 0;
};

struct CityKit {
    std::vector<Mesh> meshes;
    std::vector<Model> houses;   // at most 5.2 to each side
    std::vector<Model> towers;   // at most 9 to each side
    std::vector<Model> domes;    // at most 11 to each side
    std::vector<Model> trees;    // crowns at most 2.6 wide to each side
    std::vector<Model> willows;  // fronds that hang from 9 down to 1, up to 5 to each side
    std::vector<Model> reeds;    // tufts of about a square metre
    std::vector<Model> lamps;
    std::vector<Model> pavements;  // of a block: 36 square, the top 0.15 high

    // Adds the mesh of `points` and makes it a part of `model`.
    void addPart(Model& model, std::string name, std::vector<glm::vec3> points, std::vector<glm::vec3> colors, const Material& material) {
        Mesh mesh;
        mesh.name = std::move(name);
        mesh.points = std::move(points);
        model.patches += mesh.patchCount();
        model.parts.push_back({mesh.name, std::move(colors), material});
        meshes.push_back(std::move(mesh));
    }
};

void addBuildings(CityKit& kit);
void addPlants(CityKit& kit, Random& random);

}  // namespace tessera
