// Orders to everybody.
import type { Actions } from "./actions";
import { button } from "./dom";
import { say, type Word } from "./words";

const ARMED_MS = 5000;

/// An order to everybody takes two presses.
export function orderButton(actions: Actions, word: Word, kind: 1 | 2): HTMLButtonElement {
  let armed = 0;
  const made = button(say(word), () => {
    if (armed) {
      clearTimeout(armed);
      armed = 0;
      made.textContent = say(word);
      delete made.dataset["armed"];
      actions.raise(kind);
      return;
    }
    made.textContent = say("sure", say(word));
    made.dataset["armed"] = "yes";
    armed = window.setTimeout(() => {
      armed = 0;
      made.textContent = say(word);
      delete made.dataset["armed"];
    }, ARMED_MS);
  }, { class: `big order kind-${kind}`, id: `order-${kind}` });
  return made;
}
