// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <study/protocol.h>

namespace experiment {

/// How a simulated participant answers, beside what is preferred.
struct Behaviour {
    double lapse_rate = 0;    ///< share of answers that are tosses of a coin
    double interval_bias = 0; ///< log-odds added to the first picture
    double spread = 0;        ///< between participants: standard deviation of the reference's log-odds
    // Response times of people are right-skewed: log-normal, with a median that suits looking at two faces.
    double median_s = 2.5, log_sd = 0.4;
    double median_log_spread = 0; ///< between participants: standard deviation of the median's logarithm
};

/// A simulated participant's preferences: how likely the reference is chosen under each condition.
class Observer {
public:
    /// `description` is "paper" (the published counts), "null" (a fair coin) or the path of a TOML file.
    /// Throws support::InputError for a wrong file, or a condition of the protocol that the observer does not
    /// know.
    Observer(const std::string& description, const study::Protocol& protocol);

    /// Probability that the reference is chosen over the test shader.
    double reference_proportion(const std::string& test, const std::string& distance, int azimuth_deg) const;

    const Behaviour& behaviour() const { return behaviour_; }
    /// The description it was made from.
    const std::string& description() const { return description_; }
    /// SHA-256 of the file it was made from, or of its name.
    const std::string& digest() const { return digest_; }
    /// The shader that the others are compared with.
    const std::string& reference() const { return reference_; }

private:
    /// Conditions that match every given factor; of several, the last holds.
    struct Rule {
        std::optional<std::string> test, distance;
        std::optional<int> azimuth_deg;
        double reference_proportion;
    };
    void read_file(const study::Protocol& protocol);
    void take_published_counts(const study::Protocol& protocol);
    std::optional<double> find(const std::string& test, const std::string& distance, int azimuth_deg) const;

    std::string description_, digest_, reference_;
    Behaviour behaviour_;
    std::vector<Rule> rules_;
};

} // namespace experiment
