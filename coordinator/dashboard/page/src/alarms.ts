// What must not be missed: maydays and whatever waits for the commander's answer, over everything else; and their history.
import type { Actions } from "./actions";
import type { Alert } from "./dashboard_pb";
import { byId, button, element, KeyedList, setAttribute, setText } from "./dom";
import type { State } from "./state";
import { clock, say } from "./words";

export const keyOf = (alert: Alert) => `${alert.issuerId}/${alert.alertId}`;

function kindOf(alert: Alert): string {
  return say(alert.kind === 0 ? "mayday" : alert.kind === 1 ? "evacuate" : "rollCall");
}

/// Whom it is about, or to.
function whom(alert: Alert): string {
  return alert.subjectId || (alert.kind === 0 ? alert.issuerId : say("everybody"));
}

/// Helmets that were asked and have not answered.
function missingOf(alert: Alert, state: State): string[] {
  return state.asked.filter((id) => (!alert.subjectId || alert.subjectId === id) && !alert.acknowledgedBy.includes(id));
}

function answersOf(alert: Alert, state: State): string {
  if (alert.kind === 0) return alert.needsAnswer ? say("waits") : say("acknowledged");
  const asked = alert.subjectId ? 1 : state.asked.length;
  const missing = missingOf(alert, state);
  const names = missing.length === 0 ? "" : ` · ${say("missing", missing.join(", "))}`;
  return say("answeredBy", asked - missing.length, asked) + names;
}

function describe(alert: Alert, state: State): string {
  const text = alert.text ? ` · ${alert.text}` : "";
  const live = state.isLookingBack() ? `${say("live")} · ` : "";
  return `${live}${clock(alert.heardAtS)}${text} · ${answersOf(alert, state)}`;
}

export class Alarms {
  private readonly cried = new Set<string>();
  private readonly bands: KeyedList<Alert>;
  private readonly log: KeyedList<Alert>;

  constructor(
    private readonly state: State,
    private readonly actions: Actions,
    panel: HTMLElement,
  ) {
    this.bands = new KeyedList(byId("alarms"), (alert) => this.makeBand(alert), (row, alert) => this.update(row, alert), () => "");
    this.log = new KeyedList(panel, (alert) => this.makeRow(alert), (row, alert) => this.update(row, alert), () => say("noAlert"));
  }

  show(): void {
    const open = this.state.openAlerts();
    this.bands.show(open.filter((alert) => alert.kind !== 0 || alert.state === 0 || alert.needsAnswer).slice(0, 6), keyOf);
    const all = [...this.state.alerts].sort((a, b) => b.heardAtS - a.heardAtS);
    this.log.show(all.slice(0, 100), keyOf);
    for (const alert of open) {
      if (!alert.needsAnswer || this.cried.has(keyOf(alert))) continue;
      this.cried.add(keyOf(alert));
      byId("cried").textContent = `${kindOf(alert)}: ${whom(alert)}. ${alert.text}`;
      // Where it was then is not where it is.
      if (alert.kind === 0 && !this.state.isLookingBack()) this.actions.showHelmet(whom(alert));
    }
    document.title = open.some((alert) => alert.needsAnswer) ? `! ${say("mayday")} – Lifeline` : "Lifeline";
  }

  relabel(): void {
    this.bands.clear();
    this.log.clear();
    this.show();
  }

  private makeBand(alert: Alert): HTMLElement {
    const mayAct = this.state.mayAnswer();
    return element(
      "div",
      { class: `band kind-${alert.kind}`, "data-alert": keyOf(alert) },
      element("strong", {}, `${kindOf(alert)}: ${whom(alert)}`),
      element("span", { class: "detail" }),
      element("span", { class: "buttons" },
        button(say("show"), () => this.actions.showNow(whom(alert)), { class: "big", hidden: alert.kind !== 0 }),
        button(say("acknowledge"), () => this.actions.answer(alert, 1), { class: "big act-acknowledge", hidden: !mayAct }),
        button(say("end"), () => this.actions.answer(alert, 2), { class: "big act-end", hidden: !mayAct })),
    );
  }

  private makeRow(alert: Alert): HTMLElement {
    const mayAct = this.state.mayAnswer();
    return element(
      "article",
      { class: "card" },
      element("h3", {}, `${kindOf(alert)}: ${whom(alert)}`),
      element("p", { class: "detail" }),
      element("div", { class: "buttons" },
        button(say("acknowledge"), () => this.actions.answer(alert, 1), { class: "act-acknowledge", hidden: !mayAct }),
        button(say("end"), () => this.actions.answer(alert, 2), { class: "act-end", hidden: !mayAct })),
    );
  }

  private update(row: HTMLElement, alert: Alert): void {
    const over = alert.state === 2 ? ` · ${say("over")}` : "";
    setText(row.querySelector(".detail")!, describe(alert, this.state) + over);
    setAttribute(row, "data-waits", alert.needsAnswer ? "yes" : null);
    const mayAct = this.state.mayAnswer();
    row.querySelector<HTMLButtonElement>(".act-acknowledge")!.hidden = !mayAct || !alert.needsAnswer;
    row.querySelector<HTMLButtonElement>(".act-end")!.hidden = !mayAct || alert.needsAnswer || alert.state === 2;
  }
}
