// Where in a recording the page is: a band that cannot be taken for a live picture, and the means to move about in it.
import type { Actions } from "./actions";
import { button, element, setAttribute, setText } from "./dom";
import type { State } from "./state";
import { clock, currentLanguage, say } from "./words";

const SPEEDS = [0.5, 1, 2, 4, 10, 30, 0]; // 0: as fast as it goes

export class TimelineBar {
  private readonly what = element("strong", { id: "looking-back" });
  private readonly play = button("", () => this.actions.time.playOrPause(), { id: "play" });
  private readonly slider = element("input", { type: "range", id: "seek", min: 0, step: 1, input: () => this.seek() });
  private readonly at = element("span", { id: "recorded-at" });
  private readonly live = button("", () => this.actions.time.goLive(), { id: "back-to-live", class: "big" });
  private readonly speed = element("select", { id: "speed", change: () => this.actions.time.setSpeed(Number(this.speed.value)) });
  /// While somebody drags it, it stays where it was put.
  private heldUntilMs = 0;

  constructor(private readonly state: State, private readonly actions: Actions, private readonly band: HTMLElement) {
    band.append(this.what, this.live, this.play, this.slider, this.at, this.speed);
    this.relabel();
  }

  relabel(): void {
    setAttribute(this.slider, "aria-label", say("seek"));
    setText(this.live, say("backToLive"));
    setAttribute(this.speed, "aria-label", say("speed"));
    this.speed.replaceChildren(...SPEEDS.map((speed) => element("option", { value: speed }, speed === 0 ? say("fastest") : `${speed} ×`)));
    this.show();
  }

  show(): void {
    const { timeline } = this.state;
    this.band.hidden = timeline === null;
    document.body.dataset["time"] = timeline ? "past" : "now";
    if (!timeline) return;
    this.live.hidden = !timeline.isMissionLive;
    const target = this.actions.time.target();
    const at = new Date(1000 * (timeline.beginUnixS + timeline.atS));
    setText(this.what, say("lookingBack", at.toLocaleTimeString(currentLanguage(), { hour12: false }), at.toLocaleDateString(currentLanguage())));
    setText(this.play, timeline.isSeeking ? "…" : timeline.isPaused ? "▶" : "❚❚");
    setAttribute(this.play, "aria-label", say(timeline.isPaused ? "play" : "pause"));
    const way = timeline.isSeeking && target !== null ? ` → ${clock(target)}` : "";
    setText(this.at, `${clock(timeline.atS)}${way} / ${clock(timeline.lengthS)}`);
    this.slider.max = String(Math.ceil(timeline.lengthS));
    // On the way it shows where to.
    if (performance.now() > this.heldUntilMs) this.slider.value = String(Math.round(target ?? timeline.atS));
    setAttribute(this.slider, "aria-valuetext", clock(timeline.atS));
    if (document.activeElement !== this.speed) this.speed.value = String(SPEEDS.includes(timeline.speed) ? timeline.speed : 1);
  }

  private seek(): void {
    this.heldUntilMs = performance.now() + 1000;
    this.actions.time.goTo(Number(this.slider.value));
  }
}
