// Counts the segments of borders: all walks listed, sorted by their ends, and those with the same ends summed.
#include "border_segments.h"

#include <algorithm>

namespace tessera::splitting {

std::vector<Segment> segmentsOf(const std::vector<Border>& borders) {
    std::vector<Segment> walked;
    for (const Border& border : borders) {
        for (std::size_t k = 0; k < border.size(); ++k) {
            const Position& a = border[k].position;
            const Position& b = border[(k + 1) % border.size()].position;
            if (a < b) walked.push_back({{a, b}, 1, 1});
            if (b < a) walked.push_back({{b, a}, -1, 1});
        }
    }
    std::sort(walked.begin(), walked.end(), [](const Segment& a, const Segment& b) { return a.ends < b.ends; });
    std::vector<Segment> sums;
    for (const Segment& one : walked) {
        if (sums.empty() || sums.back().ends != one.ends) {
            sums.push_back(one);
        } else {
            sums.back().direction += one.direction;
            ++sums.back().times;
        }
    }
    return sums;
}

std::size_t openSegments(const std::vector<Border>& borders) {
    const std::vector<Segment> segments = segmentsOf(borders);
    return static_cast<std::size_t>(std::count_if(segments.begin(), segments.end(), [](const Segment& s) { return s.times % 2 != 0; }));
}

std::size_t unorientedSegments(const std::vector<Border>& borders) {
    const std::vector<Segment> segments = segmentsOf(borders);
    return static_cast<std::size_t>(std::count_if(segments.begin(), segments.end(), [](const Segment& s) { return s.direction != 0; }));
}

}  // namespace tessera::splitting
