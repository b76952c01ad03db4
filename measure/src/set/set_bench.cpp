// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "set_bench.h"

#include <chrono>
#include <cmath>
#include <numeric>

#include <fmt/chrono.h>
#include <sys/resource.h>

#include <renderer/scene/image_file.h>
#include <study/protocol.h>
#include <support/error.h>
#include <support/progress.h>
#include <support/random.h>

#include "../accuracy/sweep.h"
#include "../processor.h"
#include "../scratch_folder.h"
#include "ways.h"

namespace measure {
namespace {

namespace fs = std::filesystem;
namespace scene = renderer::scene;

/// Seconds that all threads of this process and of its ended children have computed.
double cpu_seconds() {
    double seconds = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        ::getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
            seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        }
    }
    return seconds;
}

/// RMS difference of two images of one size, in 8-bit levels.
double rms_levels(const fs::path& file, const fs::path& expected) {
    const scene::ImagePtr a = scene::read_image(file);
    const scene::ImagePtr b = scene::read_image(expected);
    double sum = 0;
    for (std::size_t i = 0; i < a->pixels.size(); ++i) {
        const double difference = static_cast<double>(a->pixels[i]) - static_cast<double>(b->pixels[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(a->pixels.size()));
}

/// What each way took.
struct Times {
    std::vector<double> seconds, cpu_seconds;
};

/// One run of the benchmark.
class Benchmark {
public:
    explicit Benchmark(const SetBenchRequest& request)
        : program_(request.program), input_(set_input(request, scratch_.path())) {
        const study::Protocol protocol = study::read_protocol(input_.protocol_file);
        result_.protocol = protocol.name;
        result_.width = protocol.image.width;
        result_.height = protocol.image.height;
        result_.quick = request.quick;
        result_.rounds = request.rounds > 0 ? request.rounds : request.quick ? 1 : 3;
        result_.processor = processor_name();
        result_.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    }

    SetResult run() {
        check();
        time();
        return std::move(result_);
    }

private:
    /// Render in each way and compare with everything on, the first one.
    void check() {
        support::Progress progress("checking", ways_.size());
        const fs::path expected = scratch_.path() / "expected";
        for (const Way& way : ways_) {
            const bool first = result_.rows.empty();
            const fs::path folder = first ? expected : scratch_.path() / "checked";
            render_in_way(way, input_, program_, folder);
            const SetFacts facts = facts_of(folder);
            if (first) {
                result_.driver = facts.driver;
                result_.model = facts.model;
            }
            check_images(way, facts, folder, expected);
            add_row(way, facts);
            if (!first) {
                fs::remove_all(folder);
            }
            progress.step(way.name + " " + way.state);
        }
        fs::remove_all(expected);
    }

    static void check_images(const Way& way, const SetFacts& facts, const fs::path& folder,
                             const fs::path& expected) {
        const SetFacts wanted = facts_of(expected);
        if (facts.digests.size() != wanted.digests.size()) {
            throw support::failure("{} {}: expected {} images, found {}", way.name, way.state,
                                   wanted.digests.size(), facts.digests.size());
        }
        for (const auto& [file, digest] : wanted.digests) {
            const auto found = facts.digests.find(file);
            if (found != facts.digests.end() && found->second == digest) {
                continue;
            }
            const double rms = rms_levels(folder / file, expected / file);
            if (!(rms <= way.bound)) {
                throw support::failure(
                    "{} {}: {}: expected the image that everything on makes, to {} levels RMS, found {}",
                    way.name, way.state, file, way.bound, rms);
            }
        }
    }

    void add_row(const Way& way, const SetFacts& facts) {
        SetRow row;
        row.name = way.name;
        row.state = way.state;
        row.images = facts.digests.size();
        row.passes = facts.passes;
        row.pixels = static_cast<long long>(row.images) * result_.width * result_.height;
        row.counts = facts.counts;
        result_.rows.push_back(row);
    }

    void time() {
        std::vector<Times> times(ways_.size());
        std::vector<std::size_t> order(ways_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        support::Generator generator("bench set order", 1);
        support::Progress progress("timing", order.size() * static_cast<std::size_t>(result_.rounds));
        for (int round = 1; round <= result_.rounds; ++round) {
            generator.shuffle(order);
            for (const std::size_t at : order) {
                time_way(ways_[at], times[at]);
                progress.step(fmt::format("round {}: {} {}", round, ways_[at].name, ways_[at].state));
            }
        }
        for (std::size_t at = 0; at < times.size(); ++at) {
            SetRow& row = result_.rows[at];
            row.seconds = median(times[at].seconds);
            row.seconds_spread = median_deviation(times[at].seconds);
            row.cpu_seconds = median(times[at].cpu_seconds);
        }
    }

    void time_way(const Way& way, Times& times) {
        const fs::path folder = scratch_.path() / "timed";
        const double cpu_start = cpu_seconds();
        const auto start = std::chrono::steady_clock::now();
        render_in_way(way, input_, program_, folder);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        times.seconds.push_back(elapsed.count());
        times.cpu_seconds.push_back(cpu_seconds() - cpu_start);
        fs::remove_all(folder);
    }

    ScratchFolder scratch_;
    fs::path program_;
    SetInput input_;
    std::vector<Way> ways_ = ways();
    SetResult result_;
};

} // namespace

SetResult run_set(const SetBenchRequest& request) { return Benchmark(request).run(); }

} // namespace measure
