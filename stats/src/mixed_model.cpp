// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/mixed_model.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

namespace stats {
namespace {

// Where sd passes this, the likelihood rises for ever.
constexpr double widest_sd = 25;

// Half the points: where they tell another standard error, all points are too few.
constexpr int coarse_points = 51;

/// How many participants answered alike; the likelihood needs each tally once.
using Groups = std::map<Tally, double>;

/// Log-likelihood at (intercept, sd) with its first and second derivatives.
struct Point {
    double value = 0;
    double by_intercept = 0, by_sd = 0;
    double intercept_twice = 0, both = 0, sd_twice = 0;
};

double logistic(double x) { return x >= 0 ? 1 / (1 + std::exp(-x)) : std::exp(x) / (1 + std::exp(x)); }

/// log(1 + exp(x)) without overflow.
double softplus(double x) { return x > 0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x)); }

/// Where and how narrowly a participant's likelihood peaks over u, with the normal's density as a factor.
struct Peak {
    double mode = 0, scale = 1;
};

Peak peak_of(const Tally& tally, double intercept, double sd) {
    const auto n = static_cast<double>(tally.n), k = static_cast<double>(tally.reference_chosen);
    Peak peak;
    // The slope falls from 0 or more at `low` to 0 or less at `high`. Newton's step where it stays between
    // them, else half the way: a steep participant would throw it from side to side.
    double low = -sd * (n - k), high = sd * k;
    constexpr int most_steps = 200;
    for (int step = 0; step < most_steps; ++step) {
        const double mu = logistic(intercept + sd * peak.mode);
        const double slope = sd * (k - n * mu) - peak.mode, curvature = 1 + sd * sd * n * mu * (1 - mu);
        peak.scale = 1 / std::sqrt(curvature);
        (slope > 0 ? low : high) = peak.mode;
        double next = peak.mode + slope / curvature;
        if (!(low <= next && next <= high)) {
            next = (low + high) / 2;
        }
        const double change = std::abs(next - peak.mode);
        peak.mode = next;
        if (change < 1e-12 * std::max(1.0, std::abs(next))) {
            break;
        }
    }
    return peak;
}

/// Nodes and steps for a participant who always answered the same: the likelihood is a cliff's edge, as steep
/// as sd, on a normal's flank, which no polynomial fits. The trapezoidal rule converges geometrically on it,
/// as the nearest singularity lies pi / (2 sd) off the axis and the tails fall like a normal's
/// [Trefethen2014].
template <typename Add>
void add_plateau(double mode, double sd, Add add) {
    constexpr double reach = 9, share = 0.25; // exp(-reach^2 / 2) and exp(-pi^2 / share) are below 1e-17
    const double step = std::min(share, share / sd);
    const double root = std::sqrt(2 * std::numbers::pi);
    const auto steps = static_cast<int>(std::ceil(reach / step));
    for (int i = -steps; i <= steps; ++i) {
        add(mode + i * step, step / root);
    }
}

/// Add one participant's log-likelihood, `times` over.
void add_participant(Point& sum, const Tally& tally, double times, double intercept, double sd,
                     const Quadrature& quadrature) {
    const auto n = static_cast<double>(tally.n), k = static_cast<double>(tally.reference_chosen);
    const Peak peak = peak_of(tally, intercept, sd);
    const auto log_density = [&](double u) {
        const double eta = intercept + sd * u;
        return k * eta - n * softplus(eta) - u * u / 2;
    };
    const double highest = log_density(peak.mode);

    // Integrate, and take the means of the derivatives over u given the answers.
    double mass = 0, score_b = 0, score_s = 0, bb = 0, bs = 0, ss = 0;
    const auto add = [&](double u, double weight) {
        const double mu = logistic(intercept + sd * u);
        const double residual = k - n * mu, information = n * mu * (1 - mu);
        mass += weight;
        score_b += weight * residual;
        score_s += weight * residual * u;
        bb += weight * (residual * residual - information);
        bs += weight * (residual * residual - information) * u;
        ss += weight * (residual * residual - information) * u * u;
    };
    if (k > 0 && k < n) {
        for (std::size_t i = 0; i < quadrature.nodes.size(); ++i) {
            const double z = quadrature.nodes[i], u = peak.mode + peak.scale * z;
            add(u, quadrature.weights[i] * peak.scale * std::exp(log_density(u) - highest + z * z / 2));
        }
    } else {
        add_plateau(peak.mode, sd,
                    [&](double u, double step) { add(u, step * std::exp(log_density(u) - highest)); });
    }
    score_b /= mass;
    score_s /= mass;

    // The second derivatives of the logarithm of an integral [Louis1982].
    sum.value += times * (highest + std::log(mass));
    sum.by_intercept += times * score_b;
    sum.by_sd += times * score_s;
    sum.intercept_twice += times * (bb / mass - score_b * score_b);
    sum.both += times * (bs / mass - score_b * score_s);
    sum.sd_twice += times * (ss / mass - score_s * score_s);
}

Point evaluate(const Groups& groups, double intercept, double sd, int points = quadrature_points) {
    static const Quadrature fine = normal_quadrature(quadrature_points),
                            coarse = normal_quadrature(coarse_points);
    const Quadrature& quadrature = points == quadrature_points ? fine : coarse;
    Point sum;
    for (const auto& [tally, times] : groups) {
        add_participant(sum, tally, times, intercept, sd, quadrature);
    }
    return sum;
}

/// Where the likelihood is highest, found by Newton's method uphill.
struct Maximum {
    double intercept = 0, sd = 0;
    Point point;
};

Maximum climb(const Groups& groups, double intercept, double sd) {
    Maximum best{intercept, sd, evaluate(groups, intercept, sd)};
    constexpr int most_steps = 200;
    constexpr double rounding = 1e-14, at_rest = 1e-11, smallest_share = 1e-3;
    for (int step = 0; step < most_steps; ++step) {
        // Newton's step where the surface is concave, else one up each slope by its own curvature.
        const Point& p = best.point;
        const double determinant = p.intercept_twice * p.sd_twice - p.both * p.both;
        const bool concave = p.intercept_twice < 0 && determinant > 0;
        constexpr double flat = 1e-9;
        double db = p.by_intercept / std::max(flat, std::abs(p.intercept_twice));
        double ds = p.by_sd / std::max(flat, std::abs(p.sd_twice));
        if (concave) {
            db = -(p.sd_twice * p.by_intercept - p.both * p.by_sd) / determinant;
            ds = -(p.intercept_twice * p.by_sd - p.both * p.by_intercept) / determinant;
        }
        const double length = std::hypot(db, ds);
        if (length > 1) {
            db /= length;
            ds /= length;
        }
        // Halve it until it leads upwards; sd and -sd are the same model.
        bool higher = false;
        for (double share = 1; share > smallest_share && !higher; share /= 2) {
            const double b = best.intercept + share * db, s = std::abs(best.sd + share * ds);
            const Point candidate = evaluate(groups, b, s);
            if (candidate.value >= p.value - rounding * std::abs(p.value)) {
                best = {b, s, candidate};
                higher = true;
            }
        }
        if (!higher || length < at_rest || best.sd > widest_sd) {
            break;
        }
    }
    return best;
}

double logit(double p) { return std::log(p / (1 - p)); }

} // namespace

Quadrature normal_quadrature(int points) {
    // Orthonormal Hermite polynomials: sqrt(j + 1) h[j+1] = x h[j] - sqrt(j) h[j-1].
    std::vector<double> root;
    for (int j = 0; j <= points; ++j) {
        root.push_back(std::sqrt(j));
    }
    const auto last_two = [&](std::size_t degree, double x) {
        double before = 0, now = 1;
        for (std::size_t j = 0; j < degree; ++j) {
            const double next = (x * now - root[j] * before) / root[j + 1];
            before = now;
            now = next;
        }
        return std::pair(before, now);
    };
    // The zeros of each degree lie between those of the degree before: halve from there. Only the last degree
    // needs them in full; before, they are borders.
    const auto count = static_cast<std::size_t>(points);
    std::vector<double> zeros;
    for (std::size_t degree = 1; degree <= count; ++degree) {
        const double outside = 2 * root[degree] + 1, close = degree == count ? 0 : 1e-5;
        std::vector<double> borders{-outside}, next;
        borders.insert(borders.end(), zeros.begin(), zeros.end());
        borders.push_back(outside);
        for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
            double low = borders[i], high = borders[i + 1];
            const bool low_negative = last_two(degree, low).second < 0;
            for (double middle = (low + high) / 2; low < middle && middle < high && high - low > close;
                 middle = (low + high) / 2) {
                ((last_two(degree, middle).second < 0) == low_negative ? low : high) = middle;
            }
            next.push_back((low + high) / 2);
        }
        zeros = std::move(next);
    }
    // The weight at a zero of h[n] is 1 / (n h[n-1]^2) [Abramowitz1964, 25.4.46].
    Quadrature result{std::move(zeros), {}};
    for (const double x : result.nodes) {
        const double before = last_two(count, x).first;
        result.weights.push_back(1 / (points * before * before));
    }
    return result;
}

std::optional<MixedModel> fit_mixed_model(std::span<const Tally> participants) {
    Groups groups;
    Tally all;
    bool twice = false, mixed = false;
    std::size_t with_answers = 0;
    for (const Tally& tally : participants) {
        if (tally.n > 0) {
            ++groups[tally];
            ++with_answers;
            all.n += tally.n;
            all.reference_chosen += tally.reference_chosen;
            twice |= tally.n > 1;
            mixed |= tally.reference_chosen > 0 && tally.reference_chosen < tally.n;
        }
    }
    // Without these the likelihood has no maximum, or sd leaves it unchanged.
    if (with_answers < 2 || !twice || !mixed) {
        return std::nullopt;
    }
    const double pooled_logit = logit(static_cast<double>(all.reference_chosen) / static_cast<double>(all.n));
    const Point alike = evaluate(groups, pooled_logit, 0);
    const Maximum top = climb(groups, pooled_logit, 1);
    const Point& p = top.point;
    const double determinant = p.intercept_twice * p.sd_twice - p.both * p.both;
    MixedModel model;
    const double ratio = 2 * (p.value - alike.value);
    constexpr double no_rise = 1e-9;
    if (ratio > no_rise) {
        // Where the likelihood rises for ever, as sd grows, no summit is reached: Newton's next step, in the
        // curvature's own measure, would not be small.
        constexpr double small = 1e-6;
        const double left_to_climb =
            (2 * p.both * p.by_intercept * p.by_sd - p.sd_twice * p.by_intercept * p.by_intercept -
             p.intercept_twice * p.by_sd * p.by_sd) /
            determinant;
        if (top.sd > widest_sd || !(p.intercept_twice < 0 && determinant > 0 && left_to_climb < small)) {
            return std::nullopt;
        }
        const double standard_error = std::sqrt(-p.sd_twice / determinant);
        const Point rough = evaluate(groups, top.intercept, top.sd, coarse_points);
        const double rough_error =
            std::sqrt(-rough.sd_twice / (rough.intercept_twice * rough.sd_twice - rough.both * rough.both));
        constexpr double same = 1e-4; // with all points, the error is about the square of it
        if (!(std::abs(rough_error / standard_error - 1) < same)) {
            return std::nullopt;
        }
        model = {top.intercept, standard_error, top.sd, 1, p.value, 1};
        const boost::math::chi_squared distribution(1);
        model.p_heterogeneity = 0.5 * boost::math::cdf(boost::math::complement(distribution, ratio));
    } else {
        model = {pooled_logit, 1 / std::sqrt(-alike.intercept_twice), 0, 1, alike.value, 1};
    }
    const boost::math::normal standard;
    model.p = 2 * boost::math::cdf(
                      boost::math::complement(standard, std::abs(model.intercept) / model.standard_error));
    return model;
}

} // namespace stats
