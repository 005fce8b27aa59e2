// The button that leads into a headset, shown where the browser says that there is one.

import {XrSession} from './xr_session.js';

/**
 * @param start  () => options of XrSession.enter() and the view: {view, ...options}; called on a click
 * @param rest   (isInVr) => void: the page's own frames rest meanwhile
 * @param fail   (line) => void
 */
export async function offerVr(button, start, rest, fail) {
  if (!await XrSession.isSupported()) return;
  button.hidden = false;
  button.addEventListener('click', async () => {
    const {view, ...options} = start();
    rest(true);
    try {
      const session = await XrSession.enter(view, options);
      await session.ended;
    } catch (error) {
      fail(`The headset can't be entered: ${error.message}`);
    } finally {
      rest(false);
    }
  });
}
