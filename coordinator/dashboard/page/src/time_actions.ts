// Moving about in what was recorded: in a recording, or back from a live mission and to it again.
import type { Link } from "./link";
import type { State } from "./state";
import { say } from "./words";

// How far back a look begins where no time is asked for.
const BACK_S = 60;
// Until the server has said where it is, it is taken to be where it was sent.
const SENT_MS = 1000;
// A slider that is dragged speaks more often than the server listens.
const LEAST_WAIT_MS = 120;

export class TimeActions {
  private wantedS = 0;
  private wentAtMs = -Infinity;
  /// How it is to be played, as it was asked for last.
  private manner = { isPaused: false, speed: 1 };
  private askedAtMs = -Infinity;
  private waiting = 0;

  constructor(
    private readonly state: State,
    private readonly link: Link,
    private readonly announce: (text: string) => void,
  ) {}

  /// Where it is going to; null where it stays or plays.
  target(): number | null {
    const { timeline } = this.state;
    const isSent = performance.now() - this.wentAtMs < SENT_MS;
    return timeline && (timeline.isSeeking || isSent) ? this.wantedS : null;
  }

  /// Back from live, and to live again. A recording stays what it is.
  lookBackOrLive(): void {
    if (this.state.isLookingBack()) this.goLive();
    else if (!this.state.timeline) this.leaveLive(this.state.now() - BACK_S);
  }
  goLive(): void {
    clearTimeout(this.waiting);
    this.waiting = 0;
    this.wentAtMs = this.askedAtMs = -Infinity;
    void this.ask({ case: "goLive", value: {} });
  }

  playOrPause(): void {
    const { isPaused, speed } = this.played();
    if (this.state.timeline) this.steer({ isPaused: !isPaused, speed });
  }
  setSpeed(speed: number): void {
    if (this.state.timeline) this.steer({ ...this.played(), speed });
  }
  skip(byS: number): void {
    const { timeline } = this.state;
    if (timeline) this.goTo((this.target() ?? timeline.atS) + byS);
    else if (byS < 0) this.leaveLive(this.state.now() + byS);
  }
  private leaveLive(toS: number): void {
    this.manner = { isPaused: false, speed: 1 };
    this.goTo(toS);
  }
  /// From the beginning, in seconds.
  goTo(toS: number): void {
    this.wantedS = Math.min(this.state.timeline?.lengthS ?? Infinity, Math.max(0, toS));
    if (this.waiting) return;
    const waitMs = Math.max(0, this.wentAtMs + LEAST_WAIT_MS - performance.now());
    this.waiting = window.setTimeout(() => {
      this.waiting = 0;
      this.wentAtMs = performance.now();
      this.steer(this.played(), this.wantedS);
    }, waitMs);
  }

  private played(): { isPaused: boolean; speed: number } {
    const { timeline } = this.state;
    if (!timeline || performance.now() - this.askedAtMs < SENT_MS) return this.manner;
    return { isPaused: timeline.isPaused, speed: timeline.speed };
  }
  private steer(manner: { isPaused: boolean; speed: number }, toS?: number): void {
    this.manner = manner;
    this.askedAtMs = performance.now();
    void this.ask({ case: "steer", value: toS === undefined ? manner : { ...manner, toS } });
  }
  /// Nothing is said where it is done: the band shows it.
  private async ask(content: Parameters<Link["ask"]>[0]): Promise<void> {
    const whyNot = await this.link.ask(content);
    if (whyNot !== "") this.announce(say("notDone", whyNot === "-" ? say("noLink") : whyNot));
  }
}
