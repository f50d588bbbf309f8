// What light loses at a rough surface where only its first meeting with a facet counts: computed, for the tables of
// loss_tables.h, by quadrature in double.
#pragma once

namespace antipode {

/// 1 − E(μ): the part of light from a direction of cosine μ in (0,1] that white GGX facets of width alpha > 0, with
/// height-correlated masking (Heitz 2014, eq. 99), do not reflect at once. Within 2·10^-4.
double metalLoss(double cosine, double alpha);

/// The part that an interface of such facets, reflecting and refracting, neither reflects nor passes on at once. eta:
/// index beyond over index on the side of the direction. Within 5·10^-4, 10^-3 near total reflection.
double glassLoss(double cosine, double alpha, double eta);

/// What a coat of such facets, of index 1.5, reflects of it at once. Within 2·10^-4.
double coatAlbedo(double cosine, double alpha);

}  // namespace antipode
