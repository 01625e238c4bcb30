#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include <oneapi/tbb/task_group.h>
#include <render/io/picture.hpp>
#include <render/stopwatch.hpp>

#include "frame_source.hpp"
#include "pace.hpp"

namespace relight {

/// What is to be shown.
struct ShownState {
    FrameState frame;
    double exposure = 0.0;  ///< stops above that of the tone curve
    int fits = 0;           ///< a change asks for the curve of the next picture at rest

    bool operator==(const ShownState&) const = default;
};

/// A picture as it is shown.
struct ShownFrame {
    ShownState state;
    int divisor = 1;  ///< the picture has a `divisor`-th of the columns and rows that were asked for; 1: at rest
    std::shared_ptr<const render::Picture> picture;
    std::vector<std::uint8_t> bytes;  ///< of the picture: sRGB, exposed
    FrameFigures figures;
    double seconds = 0.0;  ///< that the picture took

    bool is_at_rest() const { return divisor == 1; }
};

/// Makes pictures in a thread of its own, as coarse as needed while what is asked for changes, and finer ones when it
/// does not, up to the one that was asked for. The tone curve is that of the first picture at rest, until another is
/// asked for; coarser ones before that have their own.
class FrameThread {
public:
    /// `source` must outlive this object, and nobody else may use it meanwhile. `ready` is called by the thread after
    /// each picture. `pace`: what is known of the time that pictures take. threads: the source's work is spread over
    /// `threads`.
    FrameThread(FrameSource& source, int threads, std::function<void()> ready, const Pace& pace = {});
    /// Cancels what is under way.
    ~FrameThread();
    FrameThread(const FrameThread&) = delete;
    FrameThread& operator=(const FrameThread&) = delete;

    /// Asks for a picture. If it is another than the one that is under way, that is canceled if it refines a coarser
    /// one, or if it has divisor 1 and has taken more than Pace::most_seconds; else it is finished, so that there is
    /// something to see as long as states change. cost: never waits for a picture.
    void show(const ShownState& state);

    /// The newest picture, or null if there has been none since the last call. throws: what the source threw.
    std::shared_ptr<const ShownFrame> take();

private:
    /// A picture without its colors.
    struct Made {
        FrameState state;
        int divisor = 1;
        std::shared_ptr<const render::Picture> picture;
        FrameFigures figures;
        double seconds = 0.0;
    };

    class UnderWay;

    void run(int threads);
    /// Nothing if it was canceled. throws: what the source threw.
    std::optional<Made> make(const FrameState& state, int divisor, bool is_refining);
    /// Of the picture under way: a change cancels it. pre: `mutex_` is held.
    bool is_dispensable() const;
    std::shared_ptr<const ShownFrame> developed(const ShownState& state, const Made& made);

    FrameSource& source_;
    std::function<void()> ready_;
    Pace pace_;
    std::optional<render::ToneCurve> curve_;
    int fits_ = 0;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<ShownState> wanted_;
    std::shared_ptr<const ShownFrame> frame_;
    std::exception_ptr problem_;
    tbb::task_group* group_ = nullptr;  ///< of the picture under way
    bool is_refining_ = false;          ///< of that picture
    int divisor_ = 1;                   ///< of that picture
    render::Stopwatch since_begin_;     ///< of that picture
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace relight
