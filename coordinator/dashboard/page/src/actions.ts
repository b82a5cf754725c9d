// What people do, whichever way they do it: button, key or click.
import type { Alert, Find, Merge } from "./dashboard_pb";
import { byId } from "./dom";
import type { Link } from "./link";
import { findRoute, length, type Point } from "./route";
import type { State } from "./state";
import type { MapView } from "./map_view";
import { TimeActions } from "./time_actions";
import { decimals, say } from "./words";

type Pick = "measure" | "exit" | null;

// Through a building, unhurried.
const WALK_M_PER_MIN = 40;
const NOTE_MS = 12_000;

export class Actions {
  changed: () => void = () => {};
  private pick: Pick = null;
  private noteEnds = 0;
  private toShow: string | null = null;
  readonly time: TimeActions;

  constructor(
    readonly state: State,
    readonly link: Link,
    private readonly view: MapView,
  ) {
    this.time = new TimeActions(state, link, (text) => this.announce(text));
  }

  /// Stays while something is asked for, else a while.
  note(text: string): void {
    byId("map-note").textContent = text;
    clearTimeout(this.noteEnds);
    if (!this.pick) this.noteEnds = window.setTimeout(() => (byId("map-note").textContent = ""), NOTE_MS);
  }
  announce(text: string): void {
    byId("said").textContent = text;
    this.note(text);
  }

  private async order(content: Parameters<Link["ask"]>[0], done: string): Promise<void> {
    const whyNot = await this.link.ask(content);
    this.announce(whyNot === "" ? say("sent", done) : say("notDone", whyNot === "-" ? say("noLink") : whyNot));
  }

  answer(alert: Alert, state: 1 | 2): void {
    void this.order(
      { case: "answerAlert", value: { issuerId: alert.issuerId, alertId: alert.alertId, state } },
      say(state === 1 ? "acknowledge" : "end"),
    );
  }
  acknowledgeFirst(): void {
    const first = this.state.openAlerts().find((alert) => alert.needsAnswer);
    if (first) this.answer(first, 1);
  }
  raise(kind: 1 | 2): void {
    void this.order({ case: "raiseAlert", value: { kind, subjectId: "", text: "" } }, say(kind === 1 ? "evacuate" : "rollCall"));
  }
  ruleFind(find: Find, state: 0 | 1 | 2): void {
    const word = state === 1 ? "confirm" : state === 2 ? "dismiss" : "undo";
    void this.order({ case: "ruleFind", value: { agentId: find.agentId, detectionId: find.detectionId, state } }, say(word));
  }
  ruleMerge(merge: Merge, isMerged: boolean): void {
    void this.order(
      { case: "ruleMerge", value: { mapA: merge.mapA, mapB: merge.mapB, isMerged } },
      say(isMerged ? "accept" : "withdraw"),
    );
  }

  select(agentId: string | null): void {
    this.state.selected = agentId;
    this.changed();
  }
  /// Where a helmet is now, also from a look back.
  showNow(agentId: string): void {
    if (!this.state.isLookingBack()) return this.showHelmet(agentId);
    this.toShow = agentId;
    this.time.goLive();
  }
  /// Once it is known again where helmets are.
  showWhatIsWanted(): void {
    const agentId = this.toShow;
    if (agentId === null || this.state.timeline) return;
    this.toShow = null;
    this.showHelmet(agentId);
  }
  /// The one whose label ends with that number; where there is none, or several, who was heard so manieth.
  selectNumber(number: number): void {
    const helmets = this.state.helmets();
    const labelled = helmets.filter(({ agent }) => /\d+$/.exec(agent.label)?.[0] === String(number));
    const member = labelled.length === 1 ? labelled[0] : helmets.find(({ agent }) => agent.number === number);
    if (member) this.showHelmet(member.agent.agentId);
  }
  showHelmet(agentId: string): void {
    const pose = this.state.poses.get(agentId);
    this.state.selected = agentId;
    if (pose) {
      this.state.map = pose.map;
      this.view.camera.x = pose.xM;
      this.view.camera.y = pose.yM;
      this.view.camera.isHeld = true;
    }
    this.changed();
  }
  showFind(find: Find): void {
    this.state.map = find.map;
    this.view.camera.x = find.xM;
    this.view.camera.y = find.yM;
    this.view.camera.isHeld = true;
    this.changed();
  }
  showMap(map: string): void {
    this.state.map = map;
    this.state.mapChosen = true;
    this.view.camera.isHeld = false;
    this.view.route = null;
    this.view.measure = [];
    this.changed();
  }

  showSearch(): void {
    const { search } = this.state;
    search.isShown = !search.isShown;
    this.announce(say(search.isShown ? "searchOn" : "searchOff"));
    this.changed();
  }
  showWho(): void {
    const { search } = this.state;
    search.isTinted = !search.isTinted;
    const parts = [...search.shares].map(([name, { firstM2 }]) => `${name} ${decimals(firstM2, 0)} m²`);
    this.announce(search.isTinted ? say("whoOn", parts.join(", ") || "–") : say("whoOff"));
    this.changed();
  }

  startMeasure(): void {
    this.pick = "measure";
    this.view.measure = [];
    this.view.isPicking = true;
    this.note(say("pickFirst"));
    byId("map").focus();
  }
  startExit(): void {
    this.pick = "exit";
    this.view.isPicking = true;
    this.note(say("pickExit"));
    byId("map").focus();
  }
  leaveOff(): void {
    this.pick = null;
    this.view.isPicking = false;
    this.view.measure = [];
    this.view.route = null;
    this.state.selected = null;
    this.note("");
    this.changed();
  }

  /// A place on the screen was chosen. False: nobody had asked for one.
  choose(px: number, py: number): boolean {
    const [x, y] = this.view.camera.toMap(px, py);
    if (this.pick === "exit") {
      this.state.exit = { x, y };
      this.endPick("");
      return true;
    }
    if (this.pick !== "measure") return false;
    this.view.measure = [...this.view.measure, { x, y }];
    if (this.view.measure.length < 2) this.note(say("pickSecond"));
    else this.endPick(say("distance", decimals(length(this.view.measure), 2)));
    return true;
  }

  private endPick(text: string): void {
    this.pick = null;
    this.view.isPicking = false;
    this.announce(text);
    this.changed();
  }

  /// From the chosen helmet to the exit.
  showRoute(): void {
    const id = this.state.selected;
    const pose = id ? this.state.poses.get(id) : undefined;
    if (!id || !pose || pose.map !== this.state.map) return this.announce(say("routeWho"));
    const from: Point = { x: pose.xM, y: pose.yM };
    const points = findRoute(this.view.map, from, this.state.exit, this.view.cellM());
    if (points) {
      const m = length(points);
      this.view.route = { points, isFree: true };
      this.announce(say("routeOf", id, decimals(m, 0), decimals(Math.max(1, m / WALK_M_PER_MIN), 0)));
    } else {
      const trail = this.view.trailOf(id);
      this.view.route = { points: trail, isFree: false };
      this.announce(say("routeNone", id, decimals(length(trail), 0)));
    }
  }
}
