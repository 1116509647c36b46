#pragma once
// One function a figure; figures() in table.cpp lists them with their titles and sources.
#include "reports/figure.h"

namespace reports::texture {

FigureContent specimen(const StudyResult& study);
FigureContent grain_cluster(const StudyResult& study);
FigureContent progressive_failure(const StudyResult& study);
FigureContent crack_stages(const StudyResult& study);
FigureContent stress_strain(const StudyResult& study);
FigureContent crack_maps(const StudyResult& study);
FigureContent crack_counts(const StudyResult& study);
FigureContent group_shares(const StudyResult& study);
FigureContent energy_compression(const StudyResult& study);
FigureContent energy_tension(const StudyResult& study);

}  // namespace reports::texture
