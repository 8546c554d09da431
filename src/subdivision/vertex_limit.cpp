// Where a vertex of a cage goes in the limit, by refining around it until it stands still.
#include "subdivision/vertex_limit.h"

#include <cmath>

#include "subdivision/local_refinement.h"

namespace tessera::subdivision {

namespace {

// Differences fall by a third at least from level to level, once nothing is semi-sharp.
constexpr int kMostLevels = 80;
constexpr double kStill = 1e-15;

struct Row {
    std::vector<double> weights;
    void Clear() { std::fill(weights.begin(), weights.end(), 0.0); }
    void AddWithWeight(const Row& other, double weight) {
        for (std::size_t k = 0; k < weights.size(); ++k) weights[k] += weight * other.weights[k];
    }
};

double difference(const Row& a, const Row& b) {
    double most = 0.0;
    for (std::size_t k = 0; k < a.weights.size(); ++k) most = std::max(most, std::abs(a.weights[k] - b.weights[k]));
    return most;
}

}  // namespace

std::vector<double> vertexLimit(const Cage& cage, std::uint32_t vertex) {
    const std::unique_ptr<Refiner> refiner = makeRefiner(cage);
    std::vector<Row> rows(cage.points.size(), Row{std::vector<double>(cage.points.size())});
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].weights[k] = 1.0;
    const auto incident = refiner->GetLevel(0).GetVertexFaces(static_cast<int>(vertex));
    const std::vector<int> faces(incident.begin(), incident.end());
    Neighbourhood<Row> piece = Gatherer<Row>(refiner->GetLevel(0), rows).gather(faces, static_cast<int>(vertex));
    for (int level = 0; level < kMostLevels; ++level) {
        const Row before = piece.points[static_cast<std::size_t>(piece.vertex)];
        std::vector<int> childOf;
        for (std::size_t k = 0; k < faces.size(); ++k) childOf.push_back(cornerOf(piece, k));
        piece = refined(piece, childOf);
        // Sharpness ends at 10, and what has not begun to move has not stopped.
        if (level > 10 && difference(before, piece.points[static_cast<std::size_t>(piece.vertex)]) < kStill) break;
    }
    return piece.points[static_cast<std::size_t>(piece.vertex)].weights;
}

}  // namespace tessera::subdivision
