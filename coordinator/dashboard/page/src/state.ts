// What the server said last, and what people chose. Plain data: everything else reads it.
import type { Agent, Alert, Find, Fleet, Hello, Merges, Pose, ServerFrame, Timeline, Trail } from "./dashboard_pb";
import type { Point } from "./route";
import { pointsOf, SearchHelp } from "./search";

export interface Member {
  agent: Agent;
  pose: Pose | undefined;
}

export interface Way {
  agentId: string;
  map: string;
  points: Point[];
}

function wayOf(trail: Trail): Way {
  return { agentId: trail.agentId, map: trail.map, points: pointsOf(trail.pointsCm) };
}

export class State {
  hello: Hello | null = null;
  fleet: Fleet | null = null;
  merges: Merges | null = null;
  /// Of a recording, or while this page looks back; else there is none.
  timeline: Timeline | null = null;
  /// Always those of now, as who is asked by an order to everybody.
  alerts: Alert[] = [];
  asked: string[] = [];
  finds: Find[] = [];
  poses = new Map<string, Pose>();
  /// Each helmet's way on each map, in metres.
  trails: Way[] = [];
  trailsHeard = 0;
  /// Of the common map.
  readonly search = new SearchHelp();
  posesHeard = 0;
  /// The map on show; "" is the common one.
  map = "";
  /// A person chose the map: it is not changed behind their back.
  mapChosen = false;
  selected: string | null = null;
  selectedPair: string | null = null;
  exit: { x: number; y: number } = { x: 0, y: 0 };
  private nowS = 0;
  private nowAtMs = 0;

  take(frame: ServerFrame): void {
    const { content } = frame;
    switch (content.case) {
      case "hello":
        // A new connection is live.
        if (this.isLookingBack() || (this.hello && this.hello.incarnation !== content.value.incarnation)) this.forget();
        this.hello = content.value;
        break;
      case "alerts":
        this.alerts = content.value.alerts;
        this.asked = content.value.helmets;
        break;
      case "poses":
        this.setNow(content.value.nowS);
        this.posesHeard++;
        this.poses = new Map(content.value.poses.map((pose) => [pose.agentId, pose]));
        break;
      case "fleet":
        this.setNow(content.value.nowS);
        this.fleet = content.value;
        break;
      case "finds":
        this.finds = content.value.finds;
        break;
      case "merges":
        this.merges = content.value;
        break;
      case "trails":
        this.trailsHeard++;
        this.trails = content.value.trails.map(wayOf);
        break;
      case "timeline":
        if (content.value.isMissionLive && !this.timeline) this.leaveTime();
        this.timeline = content.value;
        break;
      case "live":
        this.leaveTime();
        this.timeline = null;
        break;
      case "search":
        this.search.take(content.value);
        break;
    }
  }

  /// Seconds since the coordinator's start, going on between frames: ages grow even when nothing comes. A recording's time is
  /// that of its newest frame.
  now(): number {
    return this.nowAtMs === 0 ? 0 : this.nowS + (this.timeline ? 0 : (performance.now() - this.nowAtMs) / 1000);
  }

  helmets(): Member[] {
    return (this.fleet?.agents ?? [])
      .filter((agent) => agent.isHelmet)
      .sort((a, b) => a.number - b.number)
      .map((agent) => ({ agent, pose: this.poses.get(agent.agentId) }));
  }

  /// At an earlier time of a mission that goes on.
  isLookingBack(): boolean {
    return this.timeline?.isMissionLive ?? false;
  }

  /// A commander who sees what is live.
  mayOrder(): boolean {
    return (this.hello?.mayCommand ?? false) && !this.timeline;
  }
  /// Alerts are live wherever a page looks, except in a recording.
  mayAnswer(): boolean {
    return this.mayOrder() || ((this.hello?.mayCommand ?? false) && this.isLookingBack());
  }

  /// A helmet's way on the map that is shown, without where it is now.
  trailOf(agentId: string): Point[] {
    return this.waysOf(agentId).flatMap((way) => way.points);
  }
  trailEnd(agentId: string): Point | undefined {
    return this.waysOf(agentId).at(-1)?.points.at(-1);
  }
  private waysOf(agentId: string): Way[] {
    return this.trails.filter((way) => way.agentId === agentId && way.map === this.map);
  }

  agentOf(agentId: string): Agent | undefined {
    return this.fleet?.agents.find((agent) => agent.agentId === agentId);
  }

  /// Maydays first, then what waits for an answer, then the newest.
  openAlerts(): Alert[] {
    const urgency = (alert: Alert) => (alert.needsAnswer ? 0 : 2) + (alert.kind === 0 ? 0 : 1);
    return this.alerts
      .filter((alert) => alert.state !== 2)
      .sort((a, b) => urgency(a) - urgency(b) || b.heardAtS - a.heardAtS);
  }

  private setNow(nowS: number): void {
    this.nowS = nowS;
    this.nowAtMs = performance.now();
  }

  /// What is of another time than alerts, and void at this one.
  private leaveTime(): void {
    this.fleet = this.merges = null;
    this.finds = [];
    this.trails = [];
    this.poses.clear();
    this.search.forget();
    this.nowAtMs = 0;
  }
  private forget(): void {
    this.leaveTime();
    this.timeline = null;
    this.alerts = [];
    this.asked = [];
  }
}
