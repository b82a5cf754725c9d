// Everybody's link, as a table.
import type { Agent } from "./dashboard_pb";
import { element, KeyedList, setAttribute, setText } from "./dom";
import type { State } from "./state";
import { decimals, duration, say, type Word } from "./words";

const COLUMNS: Word[] = ["name", "role", "heard", "loss", "queued", "behind", "sentBytes", "sameMap"];

function octets(count: bigint): string {
  const n = Number(count);
  if (n < 10_000) return `${n} B`;
  return n < 10_000_000 ? `${decimals(n / 1000, 0)} kB` : `${decimals(n / 1e6, 0)} MB`;
}

export class LinksPanel {
  private list: KeyedList<Agent>;

  constructor(private readonly state: State, private readonly panel: HTMLElement) {
    this.list = this.build();
  }

  show(): void {
    this.list.show(this.state.fleet?.agents ?? [], (agent) => agent.agentId);
  }
  relabel(): void {
    this.list = this.build();
    this.show();
  }

  private build(): KeyedList<Agent> {
    const body = element("tbody");
    const head = element("tr", {}, ...COLUMNS.map((word) => element("th", { scope: "col" }, say(word))));
    const table = element("table", {}, element("thead", {}, head), body);
    this.panel.replaceChildren(element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": say("links") }, table));
    const make = (agent: Agent) =>
      element("tr", {}, element("th", { scope: "row" }, agent.agentId), ...COLUMNS.slice(1).map(() => element("td")));
    return new KeyedList(body, make, (row, agent) => this.update(row, agent), () => "");
  }

  private update(row: HTMLElement, agent: Agent): void {
    const age = this.state.now() - agent.heardAtS;
    const cells = [
      say(agent.isHelmet ? "helmet" : "coordinator"),
      say("ago", duration(age)),
      agent.loss === undefined ? "–" : `${decimals(100 * agent.loss, 0)} %`,
      octets(agent.bytesQueued),
      String(agent.tilesBehind),
      octets(agent.bytesSent),
      say(agent.holdsSameMap ? "yes" : "no"),
    ];
    cells.forEach((text, i) => setText(row.children[i + 1]!, text));
    setAttribute(row, "data-urgent", agent.presence !== 0 ? "yes" : null);
  }
}
