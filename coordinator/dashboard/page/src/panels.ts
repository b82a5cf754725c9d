// Lists beside the map: team, finds, merges, links.
import type { Actions } from "./actions";
import type { Find, Merge } from "./dashboard_pb";
import { button, element, KeyedList, setAttribute, setText } from "./dom";
import { markCanvas } from "./marks";
import type { Member, State } from "./state";
import { currentLanguage, decimals, duration, say, type Word } from "./words";

const STATES: Word[] = ["starting", "tracking", "weak", "placeLost", "finished"];
const HEALTH: Word[] = ["good", "degraded", "silentSensor", "failed"];
const KINDS: Word[] = ["victim", "human", "uwbTag"];
const FIND_STATES: Word[] = ["reported", "confirmed", "dismissed", "rescued"];

export const agentOf = (map: string) => map.split("/")[0]!;

function bars(trust: number): string {
  const full = trust >= 75 ? 4 : trust >= 50 ? 3 : trust >= 25 ? 2 : trust > 0 ? 1 : 0;
  return "▮".repeat(full) + "▯".repeat(4 - full);
}

/// Who needs looking at first.
function urgency({ agent, pose }: Member): number {
  if (agent.state === 3) return 0;
  if (agent.presence === 2) return 1;
  if (agent.presence === 1 || agent.isIdUsedTwice) return 2;
  return pose && pose.trustPercent < 50 ? 3 : 4;
}

export class TeamPanel {
  private readonly list: KeyedList<Member>;

  constructor(private readonly state: State, private readonly actions: Actions, panel: HTMLElement) {
    this.list = new KeyedList(panel, (member) => this.make(member), (row, member) => this.update(row, member), () => say("noHelmet"));
  }

  show(): void {
    const members = this.state.helmets().sort((a, b) => urgency(a) - urgency(b) || a.agent.number - b.agent.number);
    this.list.show(members, ({ agent }) => agent.agentId);
  }
  relabel(): void {
    this.list.clear();
    this.show();
  }

  private make({ agent }: Member): HTMLElement {
    const choose = button("", () => this.actions.showHelmet(agent.agentId), { class: "card member" });
    choose.append(
      markCanvas(agent),
      element("span", { class: "name" }, agent.agentId),
      element("span", { class: "trust" }),
      element("span", { class: "condition" }),
      element("span", { class: "detail" }),
    );
    return choose;
  }

  private update(row: HTMLElement, { agent, pose }: Member): void {
    const age = this.state.now() - agent.heardAtS;
    const trust = pose?.trustPercent ?? 0;
    const condition =
      agent.presence === 2 ? say("silent", duration(age))
      : agent.presence === 1 ? say("late", duration(age))
      : agent.isIdUsedTwice ? say("idTwice")
      : agent.state === 1 && trust < 50 ? say("trustLow")
      : say(STATES[agent.state]!);
    const sensors = [
      agent.lidar ? `${say("lidar")} ${say(HEALTH[agent.lidar]!)}` : "",
      agent.attitude ? `${say("attitude")} ${say(HEALTH[agent.attitude]!)}` : "",
      agent.batteryPercent === undefined ? "" : say("battery", agent.batteryPercent),
      agent.floor ? say("floor", agent.floor) : "",
    ];
    const { search } = this.state;
    const share = search.shares.get(agent.agentId);
    const next = search.suggestions.find((each) => each.agentId === agent.agentId);
    const searched = [
      share && search.searchedM2 > 0 ? say("searchedFirst", decimals(share.firstM2, 0), decimals((100 * share.firstM2) / search.searchedM2, 0)) : "",
      next ? say("couldSearch", decimals(next.distanceM, 0)) : "",
    ];
    const detail = [say(agent.isInCommonMap ? "inCommon" : "notInCommon"), say("explored", decimals(agent.exploredM2, 0)), ...searched, ...sensors];
    setText(row.querySelector(".trust")!, `${say("trust")} ${bars(trust)}`);
    setText(row.querySelector(".condition")!, condition);
    setText(row.querySelector(".detail")!, detail.filter(Boolean).join(" · "));
    setAttribute(row, "data-urgent", urgency({ agent, pose }) < 3 ? "yes" : null);
    setAttribute(row, "aria-pressed", String(this.state.selected === agent.agentId));
    setAttribute(row, "data-agent", agent.agentId);
  }
}

export class FindsPanel {
  private readonly list: KeyedList<Find>;

  constructor(private readonly state: State, private readonly actions: Actions, panel: HTMLElement) {
    this.list = new KeyedList(panel, (find) => this.make(find), (row, find) => this.update(row, find), () => say("noFind"));
  }

  show(): void {
    this.list.show(this.state.finds, (find) => `${find.agentId}/${find.detectionId}`);
  }
  relabel(): void {
    this.list.clear();
    this.show();
  }

  private make(find: Find): HTMLElement {
    const current = () => this.state.finds.find((f) => f.agentId === find.agentId && f.detectionId === find.detectionId) ?? find;
    return element(
      "article",
      { class: "card find" },
      element("h3", {}),
      element("p", { class: "detail" }),
      element("div", { class: "buttons" },
        button(say("show"), () => this.actions.showFind(current())),
        button(say("confirm"), () => this.actions.ruleFind(current(), 1), { class: "act-confirm" }),
        button(say("dismiss"), () => this.actions.ruleFind(current(), 2), { class: "act-dismiss" }),
        button(say("undo"), () => this.actions.ruleFind(current(), 0), { class: "act-undo" })),
    );
  }

  private update(row: HTMLElement, find: Find): void {
    setText(row.querySelector("h3")!, `${say(KINDS[find.kind]!)}: ${say(FIND_STATES[find.state]!)}`);
    const parts = [
      say("sure2", Math.round(100 * find.confidence)),
      say("seenBy", find.seenBy.join(", ")),
      new Date(Number(find.lastSeenAtNs / 1000000n)).toLocaleTimeString(currentLanguage(), { hour12: false }),
      find.floor ? say("floor", find.floor) : "",
    ];
    setText(row.querySelector(".detail")!, parts.filter(Boolean).join(" · "));
    setAttribute(row, "data-state", String(find.state));
    const mayAct = this.state.mayOrder();
    row.querySelector<HTMLButtonElement>(".act-confirm")!.hidden = !mayAct || find.state !== 0;
    row.querySelector<HTMLButtonElement>(".act-dismiss")!.hidden = !mayAct || find.state !== 0;
    row.querySelector<HTMLButtonElement>(".act-undo")!.hidden = !mayAct || (find.state !== 1 && find.state !== 2);
  }
}

export class MergesPanel {
  private readonly list: KeyedList<Merge>;

  constructor(private readonly state: State, private readonly actions: Actions, panel: HTMLElement) {
    this.list = new KeyedList(panel, (merge) => this.make(merge), (row, merge) => this.update(row, merge), () => say("noMerge"));
  }

  static key = (merge: Merge) => `${merge.mapA} ${merge.mapB}`;

  show(): void {
    this.list.show(this.state.merges?.merges ?? [], MergesPanel.key);
  }
  relabel(): void {
    this.list.clear();
    this.show();
  }

  private make(merge: Merge): HTMLElement {
    const key = MergesPanel.key(merge);
    const togglePicture = () => {
      this.state.selectedPair = this.state.selectedPair === key ? null : key;
      this.actions.changed();
    };
    return element(
      "article",
      { class: "card merge", "data-pair": key },
      element("h3", {}, `${agentOf(merge.mapA)} + ${agentOf(merge.mapB)}: `, element("span", { class: "condition" })),
      element("p", { class: "reason" }),
      element("p", { class: "detail" }),
      element("canvas", { class: "pair", width: 320, height: 220, hidden: true, role: "img", "aria-label": say("pictureOf", agentOf(merge.mapA), agentOf(merge.mapB)) }),
      element("div", { class: "buttons" },
        button(say("picture"), togglePicture, { class: "act-picture", "aria-expanded": "false" }),
        button(say("accept"), () => this.actions.ruleMerge(merge, true), { class: "act-accept" }),
        button(say("withdraw"), () => this.actions.ruleMerge(merge, false), { class: "act-withdraw" })),
    );
  }

  private update(row: HTMLElement, merge: Merge): void {
    const word: Word = merge.isPartedByHand ? "byHandApart"
      : merge.isMergedByHand ? "byHandTogether"
      : merge.inDirective ? "accepted"
      : merge.verdict === 0 ? "notFollowed"
      : merge.verdict === 1 ? "wait" : "rejected";
    setText(row.querySelector(".condition")!, say(word));
    setText(row.querySelector(".reason")!, merge.reason);
    setText(row.querySelector(".detail")!, merge.candidates === 0 ? say("noPlace")
      : say("evidence", decimals(100 * merge.sOverlapping, 1), decimals(merge.acceptanceIndex, 2), decimals(merge.agreeingWallM, 1),
          decimals(100 * merge.conflict, 0), decimals(100 * merge.margin, 0)));
    setAttribute(row, "data-merged", merge.inDirective ? "yes" : "no");
    const mayAct = this.state.mayOrder();
    row.querySelector<HTMLButtonElement>(".act-accept")!.hidden = !mayAct || merge.inDirective || merge.candidates === 0;
    row.querySelector<HTMLButtonElement>(".act-withdraw")!.hidden = !mayAct || merge.isPartedByHand;
    const isOpen = this.state.selectedPair === MergesPanel.key(merge);
    row.querySelector<HTMLCanvasElement>("canvas")!.hidden = !isOpen;
    setAttribute(row.querySelector(".act-picture")!, "aria-expanded", String(isOpen));
  }
}
